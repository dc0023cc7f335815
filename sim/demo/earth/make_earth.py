#!/usr/bin/env python3
"""Makes earth.glb: the sphere of US 6,396,952's example (182 positions, 360 faces) with a map of an earth-like planet.

    make_earth.py OUTPUT.glb [--plain PLAIN.glb]

20 meridians and 9 parallels between two poles. Along the date line and at the poles positions repeat with other
texture coordinates: 229 in all. The outlines of the continents are rough ones drawn by hand; noise makes their coasts.
--plain writes the same sphere without the map.
"""
import argparse
import json
import math
import struct
import zlib

MERIDIANS, PARALLELS = 20, 9
WIDTH, HEIGHT = 512, 256

# (longitude, latitude) in degrees.
CONTINENTS = [
    # North America
    [(-168, 66), (-156, 71), (-128, 70), (-110, 68), (-95, 69), (-82, 68), (-93, 59), (-80, 52), (-77, 58), (-65, 60),
     (-56, 52), (-65, 46), (-71, 42), (-76, 35), (-81, 31), (-80, 25), (-84, 30), (-90, 29), (-97, 27), (-97, 20),
     (-90, 21), (-88, 16), (-83, 10), (-78, 8), (-86, 12), (-94, 16), (-105, 20), (-112, 29), (-118, 34), (-124, 41),
     (-124, 48), (-135, 58), (-150, 60), (-162, 56), (-166, 62)],
    # South America
    [(-78, 8), (-72, 12), (-61, 10), (-51, 4), (-44, -2), (-35, -6), (-39, -14), (-41, -22), (-48, -26), (-54, -34),
     (-62, -39), (-66, -46), (-69, -52), (-74, -51), (-73, -40), (-71, -30), (-70, -18), (-77, -12), (-81, -5), (-78, 2)],
    # Africa
    [(-6, 36), (10, 37), (20, 32), (32, 31), (37, 21), (43, 12), (51, 12), (47, 4), (40, -4), (40, -15), (35, -22),
     (32, -28), (26, -34), (18, -34), (14, -24), (12, -15), (9, -2), (9, 4), (-4, 5), (-12, 8), (-17, 14), (-16, 22),
     (-10, 30)],
    # Europe and Asia
    [(-9, 37), (-9, 43), (-2, 44), (-4, 48), (4, 52), (9, 54), (9, 57), (13, 55), (20, 55), (28, 60), (22, 61), (18, 60),
     (11, 59), (6, 60), (13, 66), (22, 70), (40, 67), (60, 69), (75, 72), (105, 77), (130, 72), (160, 70), (179, 67),
     (170, 60), (163, 58), (160, 53), (155, 57), (140, 54), (138, 46), (129, 41), (127, 36), (122, 40), (121, 31),
     (117, 23), (108, 20), (107, 11), (103, 13), (103, 2), (99, 8), (97, 17), (90, 22), (80, 15), (77, 8), (73, 18),
     (67, 25), (57, 26), (50, 30), (56, 25), (59, 22), (52, 16), (44, 13), (38, 22), (35, 30), (36, 36), (28, 37),
     (23, 38), (19, 42), (13, 45), (17, 40), (12, 42), (6, 43), (0, 40), (-5, 36)],
    # Australia
    [(114, -22), (122, -18), (130, -12), (137, -12), (142, -11), (146, -19), (153, -27), (150, -37), (140, -38),
     (131, -32), (123, -34), (115, -34)],
    # Greenland
    [(-55, 60), (-45, 60), (-22, 70), (-18, 80), (-40, 83), (-68, 78), (-54, 70)],
    # Islands: Great Britain, Japan, Madagascar, Borneo, New Guinea, Sumatra, New Zealand, Iceland
    [(-5, 50), (1, 52), (-2, 58), (-6, 57), (-4, 54)],
    [(131, 32), (136, 34), (141, 36), (144, 44), (140, 43), (138, 37)],
    [(44, -24), (48, -24), (50, -15), (45, -17)],
    [(109, 1), (116, 6), (118, 1), (115, -4), (110, -2)],
    [(131, -1), (141, -3), (150, -9), (144, -9), (136, -5)],
    [(96, 5), (104, -2), (105, -6), (101, -3)],
    [(173, -41), (178, -38), (174, -36), (171, -43), (167, -46)],
    [(-23, 64), (-14, 65), (-17, 66), (-23, 66)],
]


def lattice(x, y, z):
    h = (x * 374761393 + y * 668265263 + z * 2147483647) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    return (h ^ (h >> 16)) / 0xFFFFFFFF


def noise(p):
    """Trilinear value noise in [0, 1], smooth over the sphere: there is no seam in it."""
    cell = [math.floor(c) for c in p]
    f = [c - k for c, k in zip(p, cell)]
    f = [c * c * (3 - 2 * c) for c in f]
    total = 0.0
    for corner in range(8):
        d = [corner & 1, corner >> 1 & 1, corner >> 2]
        weight = 1.0
        for k in range(3):
            weight *= f[k] if d[k] else 1 - f[k]
        total += weight * lattice(cell[0] + d[0], cell[1] + d[1], cell[2] + d[2])
    return total


def fractal(direction, scale, offset):
    return sum(noise([c * scale * 2**o + offset for c in direction]) / 2**(o + 1) for o in range(4)) / 0.9375 - 0.5


def inside(polygon, x, y):
    odd = False
    for (x0, y0), (x1, y1) in zip(polygon, polygon[1:] + polygon[:1]):
        if (y0 > y) != (y1 > y) and x < x0 + (y - y0) / (y1 - y0) * (x1 - x0):
            odd = not odd
    return odd


def mixed(a, b, t):
    t = min(1.0, max(0.0, t))
    return [p + (q - p) * t for p, q in zip(a, b)]


def colour(longitude, latitude):
    phi, theta = math.radians(longitude), math.radians(latitude)
    direction = (math.cos(theta) * math.cos(phi), math.sin(theta), math.cos(theta) * math.sin(phi))
    x = longitude + 9 * fractal(direction, 6, 11) / max(0.35, math.cos(theta))
    y = latitude + 9 * fractal(direction, 6, 47)
    height = fractal(direction, 5, 83)
    ice = abs(latitude) + 14 * height
    if latitude < -60 and y < -68:
        land = [238, 242, 246]
    elif any(inside(c, x, y) for c in CONTINENTS):
        dry = math.exp(-((abs(latitude) - 23) / 9)**2) * (1.1 if -20 < longitude < 60 or longitude > 110 else 0.5)
        land = mixed([52, 118, 48], [206, 176, 112], dry + 0.6 * height)
        land = mixed(land, [120, 104, 84], 2.2 * (height - 0.12))
        land = mixed(land, [88, 116, 84], (abs(latitude) - 50) / 14)
        land = mixed(land, [240, 244, 248], (ice - 66) / 8)
    else:
        land = mixed(mixed([24, 84, 160], [14, 52, 118], 0.5 + 1.5 * height), [226, 236, 244], (ice - 76) / 6)
    return land


def picture():
    rows = []
    for j in range(HEIGHT):
        latitude = 90 - 180 * (j + 0.5) / HEIGHT
        row = bytearray([0])  # no filter
        for i in range(WIDTH):
            longitude = 360 * (i + 0.5) / WIDTH - 180
            c = colour(longitude, latitude)
            # Meridians and parallels every 30 degrees show at once where a texture is torn or bent.
            to_line = min(abs((longitude + 15) % 30 - 15) * math.cos(math.radians(latitude)),
                          abs((latitude + 15) % 30 - 15))
            if to_line < 0.36:
                c = mixed(c, [255, 255, 255], 0.45)
            row += bytes(int(v + 0.5) for v in c)
        rows.append(bytes(row))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(b"".join(rows), 9)) + chunk(b"IEND", b""))


def sphere():
    """Positions, texture coordinates and faces, counter-clockwise from outside. The y axis goes through the poles."""
    positions, coordinates, faces = [], [], []

    def vertex(meridian, parallel, s):
        phi = 2 * math.pi * (meridian % MERIDIANS) / MERIDIANS - math.pi
        theta = math.pi * parallel / (PARALLELS + 1)
        r = math.sin(theta) if 0 < parallel <= PARALLELS else 0.0
        positions.append([round(c, 9) + 0.0 for c in (r * math.cos(phi), math.cos(theta), -r * math.sin(phi))])
        coordinates.append([s / MERIDIANS, parallel / (PARALLELS + 1)])
        return len(positions) - 1

    rings = [[vertex(m, p, m) for m in range(MERIDIANS + 1)] for p in range(1, PARALLELS + 1)]
    north = [vertex(m, 0, m + 0.5) for m in range(MERIDIANS)]
    south = [vertex(m, PARALLELS + 1, m + 0.5) for m in range(MERIDIANS)]
    for m in range(MERIDIANS):
        faces.append([north[m], rings[0][m], rings[0][m + 1]])
        for upper, lower in zip(rings, rings[1:]):
            faces.append([upper[m], lower[m], lower[m + 1]])
            faces.append([upper[m], lower[m + 1], upper[m + 1]])
        faces.append([south[m], rings[-1][m + 1], rings[-1][m]])
    return positions, coordinates, faces


def glb(textured):
    positions, coordinates, faces = sphere()
    parts = [b"".join(struct.pack("<3f", *p) for p in positions)]  # the normals are the positions
    if textured:
        parts.append(b"".join(struct.pack("<2f", *c) for c in coordinates))
    parts.append(b"".join(struct.pack("<3H", *f) for f in faces))
    if textured:
        parts.append(picture())
    views, buffer = [], b""
    for part in parts:
        views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(part)})
        buffer += part + bytes(-len(part) % 4)
    accessors = [{"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3",
                  "min": [min(p[k] for p in positions) for k in range(3)],
                  "max": [max(p[k] for p in positions) for k in range(3)]}]
    attributes = {"POSITION": 0, "NORMAL": 0}
    material = {"name": "Earth", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1], "metallicFactor": 0}}
    model = {"asset": {"version": "2.0", "generator": "make_earth.py"}, "scene": 0, "scenes": [{"nodes": [0]}],
             "nodes": [{"name": "Earth", "mesh": 0}]}
    if textured:
        attributes["TEXCOORD_0"] = len(accessors)
        accessors.append({"bufferView": 1, "componentType": 5126, "count": len(coordinates), "type": "VEC2"})
        material["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
        model["textures"] = [{"source": 0, "sampler": 0}]
        model["images"] = [{"name": "map", "bufferView": 3, "mimeType": "image/png"}]
        model["samplers"] = [{"magFilter": 9729, "minFilter": 9985, "wrapS": 10497, "wrapT": 33071}]
    accessors.append({"bufferView": 2 if textured else 1, "componentType": 5123, "count": 3 * len(faces),
                      "type": "SCALAR"})
    primitive = {"attributes": attributes, "indices": len(accessors) - 1, "material": 0}
    model.update({"meshes": [{"name": "Earth", "primitives": [primitive]}], "materials": [material],
                  "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(buffer)}]})
    text = json.dumps(model, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(buffer), b"BIN\0") + buffer
    return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("output")
    parser.add_argument("--plain")
    options = parser.parse_args()
    with open(options.output, "wb") as file:
        file.write(glb(True))
    if options.plain:
        with open(options.plain, "wb") as file:
            file.write(glb(False))


if __name__ == "__main__":
    main()
