#!/usr/bin/env python3
"""How does meshing a field, its evaluation included, compare with contouring a grid that is filled already?"""

import json
import statistics
import time

import study

try:
    from vtkmodules import vtkCommonCore, vtkFiltersCore, vtkIOImage
    HAS_VTK = True
except ImportError:
    HAS_VTK = False

ISO_VALUE = 0.5
REPETITIONS = 5


def ours_and_openvdb(result, side, threads, grid):
    run = study.run([result.program('bench/bench_contour'), '--side', side, '--threads', threads, '--turns',
                     REPETITIONS, '--write-grid', grid], result.options.limit)
    return json.loads(run['output']) if run else None


def vtk_image(grid, side):
    reader = vtkIOImage.vtkImageReader2()
    reader.SetFileName(str(grid))
    reader.SetFileDimensionality(3)
    reader.SetDataExtent(0, side - 1, 0, side - 1, 0, side - 1)
    reader.SetDataScalarTypeToFloat()
    reader.SetDataByteOrderToLittleEndian()
    reader.Update()
    return reader.GetOutput()


def flying_edges(image, threads):
    """Seconds, warm, and triangles."""
    vtkCommonCore.vtkSMPTools.Initialize(threads)
    seconds = []
    for _ in range(REPETITIONS + 1):
        contour = vtkFiltersCore.vtkFlyingEdges3D()
        contour.SetInputData(image)
        contour.SetValue(0, ISO_VALUE)
        contour.ComputeNormalsOff()
        contour.ComputeGradientsOff()
        contour.ComputeScalarsOff()
        start = time.perf_counter()
        contour.Update()
        seconds.append(time.perf_counter() - start)
    return {'seconds': statistics.median(seconds[1:]), 'triangles': contour.GetOutput().GetNumberOfPolys()}


def measure(result, side, threads):
    """A row for each program."""
    grid = result.path('grid.raw')
    runs = {}
    for _ in range(result.options.turns):
        numbers = ours_and_openvdb(result, side, threads, grid)
        if not numbers:
            return [['barkridge, OpenVDB', threads, 'failed']]
        turn = numbers['contourers']
        if HAS_VTK:
            turn[f'VTK {vtkCommonCore.vtkVersion.GetVTKVersion()} Flying Edges'] = flying_edges(vtk_image(grid, side), threads)
        for program, run in turn.items():
            runs.setdefault(program, []).append(run)
    if threads == 1 and not any(program.startswith('OpenVDB') for program in runs):
        result.skip('OpenVDB')
    rows = []
    for program, of in runs.items():
        seconds = study.Samples(run['seconds'] for run in of)
        middle, triangles = seconds.spread()[0], of[0]['triangles']
        rows.append([program, threads, *seconds.spread(), triangles, 1e-6 * triangles / middle,
                     1e-6 * side ** 3 / middle])
    return rows


def main():
    parser = study.arguments(__doc__)
    parser.add_argument('--side', type=int, default=256, help='points along a side of the grid')
    options = parser.parse_args()
    result = study.Study(__doc__, options)
    result.skeleton(200, 2)
    if not HAS_VTK:
        result.skip('VTK\'s Python module')
    rows = []
    for threads in sorted({1, options.threads}):
        rows += measure(result, options.side, threads)
    result.add(f'200 internodes, exponent 2, smooth, on a grid of {options.side}^3',
               ['program', 'threads', 's', 'least', 'most', 'triangles', 'M triangles/s', 'M points/s'], rows,
               ['barkridge evaluates the field within these times; the others read a grid whose filling is not counted',
                'signs alone: without leaving out what is too small for the lattice, as the others do it',
                'OpenVDB skips empty space and reads its own sparse copy; copying is not counted'])
    return result.finish()


if __name__ == '__main__':
    main()
