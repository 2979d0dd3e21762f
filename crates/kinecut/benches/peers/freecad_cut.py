"""FreeCAD's simulator of tool paths (module PathSimulator) without its window: freecadcmd freecad_cut.py

What to do stands in the environment: MOVES (file of f64), DIAMETER, CORNER, STOCK, STEP, MESH (file to write). Its own time is
that from the block to the mesh; the start of FreeCAD does not count.
"""

import json
import os
import struct
import time

import FreeCAD
import Part
import Path
import PathSimulator

WORDS = os.environ


def shape(radius, corner):
    """The tool: its section turned about z."""
    at, flat = FreeCAD.Vector, radius - corner
    if corner == 0:
        return Part.makeCylinder(radius, 40)
    turn = 0.5**0.5 * corner
    edges = [Part.Arc(at(flat, 0, 0), at(flat + turn, 0, corner - turn), at(radius, 0, corner)).toShape()]
    corners = [at(radius, 0, corner), at(radius, 0, 40), at(0, 0, 40), at(0, 0, 0)] + ([at(flat, 0, 0)] if flat > 0 else [])
    edges += [Part.makeLine(a, b) for a, b in zip(corners, corners[1:])]
    solid = Part.Face(Part.Wire(edges)).revolve(at(0, 0, 0), at(0, 0, 1), 360)
    return solid if solid.ShapeType == "Solid" else Part.Solid(Part.Shell(solid.Faces))


def main():
    with open(WORDS["MOVES"], "rb") as file:
        moves = list(struct.iter_unpack("<4d", file.read()))
    stock, step = [float(v) for v in WORDS["STOCK"].split(",")], float(WORDS["STEP"])
    size = [b - a for a, b in zip(stock, stock[3:])]
    tool = shape(float(WORDS["DIAMETER"]) / 2, float(WORDS["CORNER"]))
    wall, cpu = time.time(), time.process_time()
    simulator = PathSimulator.PathSim()
    simulator.BeginSimulation(Part.makeBox(*size, FreeCAD.Vector(*stock[:3])), step)
    simulator.SetToolShape(tool, 0.05 * step)
    place = FreeCAD.Placement(FreeCAD.Vector(*moves[0][1:]), FreeCAD.Rotation())
    for rapid, x, y, z in moves[1:]:
        place = simulator.ApplyCommand(place, Path.Command("G0" if rapid else "G1", {"X": x, "Y": y, "Z": z}))
    outer, inner = simulator.GetResultMesh()
    answer = {"wall": time.time() - wall, "cpu": time.process_time() - cpu}
    mesh = outer.copy()
    mesh.addMesh(inner)
    mesh.write(WORDS["MESH"])
    volume = size[0] * size[1] * size[2]
    answer |= {"triangles": mesh.CountFacets, "removed": volume - abs(mesh.Volume), "closed": mesh.isSolid()}
    print("RESULT " + json.dumps(answer), flush=True)
    os._exit(0)  # FreeCAD would wait for commands


main()
