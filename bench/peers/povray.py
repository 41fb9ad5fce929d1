#!/usr/bin/env python3
"""How much faster than POV-Ray's blob is a picture of the same tree?"""

import math
import re
import shutil

import study

WIDTH, HEIGHT = 768, 1024
HALF_WIDTH = math.radians(10.5)
CAMERA, TARGET, LIGHT = (0.35, 0.62, -2.35), (0, 0.5, 0), (-4, 6, -5)


def vector(v):
    return '<%.9g,%.9g,%.9g>' % tuple(v)


def povray_scene(skeleton):
    """One blob: a cylinder of the mean radius for every internode, which alone has its surface there.

    POV-Ray's falloff is (1 - d^2/R^2)^2, so with R = 2 r the threshold is 9/16. Its axes are left-handed: the camera's
    right is turned round.
    """
    lines = ['#version 3.7;', 'global_settings { assumed_gamma 1 }', 'background { color rgb 1 }',
             f'camera {{ perspective location {vector(CAMERA)} look_at {vector(TARGET)}',
             f'  right {-WIDTH / HEIGHT}*x up y angle {math.degrees(2 * HALF_WIDTH)} }}',
             f'light_source {{ {vector(LIGHT)} color rgb 1 }}', 'blob { threshold 0.5625']
    for line in skeleton.read_text().splitlines()[1:]:
        n = [float(word) for word in line.split()[2:]]
        lines.append(f'cylinder {{ {vector(n[0:3])}, {vector(n[3:6])}, {n[6] + n[7]:.9g}, 1 }}')
    return '\n'.join(lines + ['pigment { color rgb <0.38,0.31,0.24> } }', ''])


def barkridge_scene(skeleton, junction):
    fov = 2 * math.degrees(math.atan(math.tan(HALF_WIDTH) * HEIGHT / WIDTH))
    return f'''version = 1
[model]
skeleton = "{skeleton.name}"
[junction]
kind = "{junction}"
[camera]
position = {list(CAMERA)}
target = {list(TARGET)}
fov_degrees = {fov}
[sun]
direction = {list(LIGHT)}
angle_degrees = 0
[sky]
intensity = 0
[ground]
enabled = false
[material]
specular = 0
[image]
bounces = 0
'''


def trace_seconds(output):
    """What POV-Ray says that tracing alone took; nothing if it says nothing."""
    found = re.search(r'Trace Time:.*\(([0-9.]+) seconds\)', output)
    return float(found[1]) if found else None


def povray_version():
    found = re.search(r'POV-Ray ([0-9][0-9.]*[0-9])', study.run(['povray', '--version'], 10)['output'])
    return found[1] if found else 'of unknown version'


def compare(result, internodes, smoothed):
    """A row for each program; the figure is ridges against the blob, which can only blend."""
    options = result.options
    skeleton = result.skeleton(internodes)
    scene = skeleton.with_suffix('.pov')
    scene.write_text(povray_scene(skeleton))
    picture = result.path('picture.png')
    things = {'POV-Ray blob': lambda: study.run(
        ['povray', f'+I{scene}', f'+O{picture}', f'+W{WIDTH}', f'+H{HEIGHT}', '-D', '-V', f'+WT{options.threads}']
        + (['+A0.3', '+R3'] if smoothed else ['-A']), options.limit)}
    for junction in 'smooth', 'ridge':
        toml = skeleton.with_name(f'{skeleton.stem}_{junction}.toml')
        toml.write_text(barkridge_scene(skeleton, junction))
        things[f'barkridge {junction}'] = lambda toml=toml: study.run(
            [result.program('barkridge'), 'render', toml, '-o', picture, '-q', '--size', f'{WIDTH}x{HEIGHT}', '--spp',
             9 if smoothed else 1, '--threads', options.threads], options.limit)
    return rows_of(result, f'{internodes}{"_smoothed" if smoothed else ""}', study.take_turns(things, options.turns))


def rows_of(result, name, runs):
    rows = []
    peer = runs['POV-Ray blob']
    samples = {program: study.Samples(run['wall'] for run in of) for program, of in runs.items() if of}
    traces = study.Samples(trace_seconds(run['output']) for run in peer or [])
    for program, of in runs.items():
        if not of:
            rows.append([name, program, 'failed'])
            if program == 'barkridge ridge':
                result.figure(f'render_{name}_to_povray', None)
            continue
        trace = times = traced = None
        if of is peer:
            trace = traces.spread()[0]
        elif peer:
            times = samples['POV-Ray blob'].over(samples[program])
            traced = traces.over(samples[program])
            if program == 'barkridge ridge':
                result.figure(f'render_{name}_to_povray', times)
        rows.append([name, program, *samples[program].spread(), trace, max(run['cpu'] for run in of),
                     max(run['peak'] for run in of), times, traced])
    return rows


def main():
    parser = study.arguments(__doc__)
    parser.add_argument('--sizes', type=int, nargs='*', default=[2000, 20000, 200000], help='internodes, one sample')
    parser.add_argument('--smoothed', type=int, nargs='*', default=[20000],
                        help='internodes, +A0.3 +R3 against at most 9 samples')
    result = study.Study(__doc__, parser.parse_args())
    if not shutil.which('povray'):
        result.skip('POV-Ray')
        return result.finish()
    rows = []
    for internodes in result.options.sizes:
        rows += compare(result, internodes, False)
    for internodes in result.options.smoothed:
        rows += compare(result, internodes, True)
    result.add(
        f'{WIDTH} x {HEIGHT}, {result.options.threads} threads: whole processes, from the skeleton to a PNG',
        ['internodes', 'program', 's', 'least', 'most', 'trace s', 'cpu s', 'peak MB', 'POV-Ray/ours', 'its trace/ours'],
        rows,
        [f'POV-Ray {povray_version()}',
         'POV-Ray/ours: of whole processes, turn by turn; its trace/ours: what POV-Ray says that tracing alone took '
         'over our whole process',
         'the blob has cylinders of the mean radius and blends by sum; smoothed: +A0.3 +R3 against at most 9 samples'])
    return result.finish()


if __name__ == '__main__':
    main()
