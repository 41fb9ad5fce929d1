"""Run by Blender: meshes a skeleton table as metaballs, one capsule an internode, and prints what it took.

    blender -b --factory-startup --python blender_metaballs.py -- SKELETON CELL_SIZE REPETITIONS
"""

import json
import pathlib
import sys
import time

import bpy
from mathutils import Vector

# Blender takes no cells below 0.005: everything is drawn this much larger.
SCALE = 10
# (1 - d^2/R^2)^3 at d = R/2 times the stiffness is the threshold: a lone capsule has its surface at half its radius.
THRESHOLD = 0.5
STIFFNESS = THRESHOLD / 0.75 ** 3


def add_capsule(balls, line):
    n = [SCALE * float(word) for word in line.split()[2:]]
    base, tip = Vector(n[0:3]), Vector(n[3:6])
    capsule = balls.elements.new(type='CAPSULE')
    capsule.co = (base + tip) / 2
    capsule.size_x = (tip - base).length / 2
    capsule.radius = n[6] + n[7]
    capsule.stiffness = STIFFNESS
    capsule.rotation = Vector((1, 0, 0)).rotation_difference(tip - base)


def triangles_of(tree):
    """Makes Blender polygonize again."""
    tree.data.update_tag()
    tree.update_tag()
    graph = bpy.context.evaluated_depsgraph_get()
    graph.update()
    evaluated = tree.evaluated_get(graph)
    count = sum(polygon.loop_total - 2 for polygon in evaluated.to_mesh().polygons)
    evaluated.to_mesh_clear()
    return count


def main():
    skeleton, cell_size, repetitions = sys.argv[sys.argv.index('--') + 1:]
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    balls = bpy.data.metaballs.new('tree')
    balls.resolution = balls.render_resolution = SCALE * float(cell_size)
    balls.threshold = THRESHOLD
    for line in pathlib.Path(skeleton).read_text().splitlines()[1:]:
        add_capsule(balls, line)
    tree = bpy.data.objects.new('tree', balls)
    bpy.context.collection.objects.link(tree)
    times = []
    for _ in range(int(repetitions)):
        start = time.perf_counter()
        triangles = triangles_of(tree)
        times.append(time.perf_counter() - start)
    print('RESULT ' + json.dumps({'seconds': sorted(times)[len(times) // 2], 'triangles': triangles,
                                    'version': bpy.app.version_string}))


main()
