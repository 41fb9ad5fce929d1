"""What the comparisons with other programs share: whole processes that take turns, and tables as JSON.

The files have the form that the C++ studies write (bench/support/study.h), and bench/report reads both.
"""

import argparse
import datetime
import json
import os
import pathlib
import resource
import signal
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]


def arguments(question):
    """A parser with what every comparison takes."""
    parser = argparse.ArgumentParser(description=question)
    parser.add_argument('--build', type=pathlib.Path, default=ROOT / 'build' / 'release', help='where the programs are')
    parser.add_argument('--json', type=pathlib.Path, help='also write the tables to this file')
    parser.add_argument('--turns', type=int, default=3, help='turns of every measurement that count')
    parser.add_argument('--threads', type=int, default=os.cpu_count())
    parser.add_argument('--limit', type=int, default=600, help='most seconds of a process')
    return parser


class Study:
    """Collects tables and figures; prints as it goes."""

    def __init__(self, question, options):
        self.name = pathlib.Path(sys.argv[0]).stem
        self.question, self.options = question, options
        self.tables, self.figures, self.skipped = [], {}, []
        self.machine = {}
        self.folder = tempfile.TemporaryDirectory(prefix='barkridge_bench_')
        print(question)

    def path(self, name):
        return pathlib.Path(self.folder.name) / name

    def program(self, name):
        return str(self.options.build / name)

    def skeleton(self, internodes, exponent=0):
        """The path of the sample tree's skeleton table."""
        path, facts = self.path(f'{internodes}_{exponent}.skel'), self.path('tree.json')
        subprocess.run([self.program('bench/bench_tree'), '--sizes', str(internodes), '--exponent', str(exponent),
                        '--write', path, '--json', facts], check=True, stdout=subprocess.DEVNULL)
        self.machine = self.machine or json.loads(facts.read_text())['machine']
        return path

    def skip(self, what):
        print(f'{what} is not installed: skipped')
        self.skipped.append(f'{what} was not installed.')

    def add(self, title, columns, rows, notes=()):
        if not rows:
            return
        self.tables.append({'title': title, 'columns': columns, 'rows': rows, 'notes': list(notes)})
        lines = [columns] + [[text_of(cell) for cell in row] for row in rows]
        widths = [max(len(line[i]) for line in lines if i < len(line)) for i in range(len(columns))]
        print('\n' + title)
        for line in lines:
            print('  ' + '  '.join(cell.rjust(width) for cell, width in zip(line, widths)))
        for note in notes:
            print(f'  ({note})')

    def figure(self, name, value):
        self.figures[name] = value

    def finish(self):
        if self.options.json:
            self.options.json.write_text(json.dumps({
                'program': self.name, 'question': self.question, 'date': datetime.date.today().isoformat(),
                'machine': self.machine, 'figures': self.figures, 'tables': self.tables, 'skipped': self.skipped,
            }, indent=1) + '\n')
        self.folder.cleanup()


def text_of(cell):
    """A cell as the tables show it: numbers that are not whole with three digits."""
    if cell is None or cell != cell:
        return '-'
    if not isinstance(cell, float):
        return str(cell)
    rounded = float(f'{cell:.2e}')
    magnitude = int(f'{rounded:e}'.split('e')[1])
    return f'{rounded:.{min(max(2 - magnitude, 0), 9)}f}'


def bound(limit):
    """Makes this process end after so many seconds, or when it needs nearly all of the machine's memory."""
    signal.alarm(limit)
    memory = int(0.8 * os.sysconf('SC_PHYS_PAGES') * os.sysconf('SC_PAGE_SIZE'))
    resource.setrlimit(resource.RLIMIT_AS, (memory, memory))


def run(command, limit):
    """Runs a whole process: what it took, and what it said. Nothing if it failed or took too long."""
    with tempfile.TemporaryFile('w+') as output:
        start = time.perf_counter()
        child = subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=output,
                                 stderr=subprocess.STDOUT, preexec_fn=lambda: bound(limit))
        _, status, usage = os.wait4(child.pid, 0)
        wall = time.perf_counter() - start
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode:
            return None
        output.seek(0)
        return {'wall': wall, 'cpu': usage.ru_utime + usage.ru_stime, 'peak': 1.024e-3 * usage.ru_maxrss,
                'output': output.read()}


class Samples:
    """What a thing took, turn by turn."""

    def __init__(self, values):
        self.values = list(values)

    def spread(self):
        """Median, least, most."""
        return [statistics.median(self.values), min(self.values), max(self.values)]

    def over(self, other):
        """The median of the ratios, turn by turn."""
        return statistics.median(a / b for a, b in zip(self.values, other.values))


def take_turns(things, turns):
    """Calls every function by turns, A B C, A B C, ..., after one turn that does not count; the results in lists.

    A function that returns nothing has failed, and is not called again.
    """
    results = {name: [] for name in things}
    for turn in range(turns + 1):
        for name, thing in things.items():
            if results[name] is None:
                continue
            result = thing()
            if result is None:
                results[name] = None
                print(f'{name} failed', file=sys.stderr)
            elif turn:
                results[name].append(result)
    return results
