#!/usr/bin/env python3
"""How fast are triangles against Blender's metaballs, fields included?"""

import json
import pathlib
import re
import shutil

import study

SCRIPT = pathlib.Path(__file__).with_name('blender_metaballs.py')
REPETITIONS = 5


def blender(skeleton, cell_size, limit):
    """Seconds of the metaballs' evaluation alone, warm, and triangles."""
    run = study.run(['blender', '-b', '--factory-startup', '--python', SCRIPT, '--', skeleton, cell_size, REPETITIONS],
                    limit)
    found = run and re.search(r'^RESULT (.*)$', run['output'], re.MULTILINE)
    return dict(json.loads(found[1]), peak=run['peak']) if found else None


def barkridge(result, case, surface):
    """Seconds from the skeleton to triangles, warm, and triangles."""
    run = study.run([result.program('bench/bench_mesh_size'), '--once', '--cases', case, '--surfaces', surface,
                     '--threads', result.options.threads], result.options.limit)
    if not run:
        return None
    numbers = json.loads(run['output'])
    return {'seconds': numbers['total'], 'triangles': int(numbers['triangles']), 'peak': numbers['peak'] / 1e6}


def main():
    parser = study.arguments(__doc__)
    parser.add_argument('--internodes', type=int, default=200)
    parser.add_argument('--exponent', type=float, default=2)
    parser.add_argument('--cell-size', type=float, default=0.004)
    options = parser.parse_args()
    result = study.Study(__doc__, options)
    if not shutil.which('blender'):
        result.skip('Blender')
        return result.finish()
    skeleton = result.skeleton(options.internodes, options.exponent)
    case = f'{options.internodes}:{options.cell_size}:{options.exponent:g}'
    runs = study.take_turns({
        'Blender metaballs': lambda: blender(skeleton, options.cell_size, options.limit),
        'barkridge smooth': lambda: barkridge(result, case, 'smooth'),
        'barkridge ridge': lambda: barkridge(result, case, 'ridge'),
    }, options.turns)
    peer = runs['Blender metaballs']
    rows = []
    for program, of in runs.items():
        if not of:
            rows.append([program, 'failed'])
            continue
        seconds = study.Samples(run['seconds'] for run in of)
        rate = study.Samples(1e-6 * run['triangles'] / run['seconds'] for run in of)
        times = None
        if peer and of is not peer:
            times = rate.over(study.Samples(1e-6 * run['triangles'] / run['seconds'] for run in peer))
            result.figure(f'mesh_{program.split()[1]}_to_blender', times)
        rows.append([program, *seconds.spread(), of[0]['triangles'], rate.spread()[0], max(run['peak'] for run in of),
                     times])
    result.add(f'{options.internodes} internodes, exponent {options.exponent:g}, cell {options.cell_size}',
               ['program', 's', 'least', 'most', 'triangles', 'M triangles/s', 'peak MB', 'rate over Blender\'s'], rows,
               ([f'Blender {peer[0]["version"]}'] if peer else []) +
               ['evaluation alone, warm: without Blender\'s start and scene; ours from the skeleton on',
                'metaballs have the mean radius and blend by sum, and run on one thread; '
                f'ours on {options.threads}'])
    return result.finish()


if __name__ == '__main__':
    main()
