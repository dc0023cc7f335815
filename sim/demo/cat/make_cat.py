#!/usr/bin/env python3
"""Makes cat.json: a cat with its things, 63 solids, as many as Shindo et al. (1995) show of theirs when all are rough.

    make_cat.py OUTPUT.json

The cat sits, its face towards +z, its back towards -z; y is up and the floor is y = 0. Lengths are in centimetres.
"""
import argparse
import json

FUR, BELLY, DARK, PINK, WHITE, EYE, BLACK, COLLAR, BELL = (
    "#d08a4a", "#f0dcc0", "#8a5228", "#e8a0a0", "#fafafa", "#70a840", "#181818", "#b02030", "#e0c040")


def solid(name, kind, colour, position, rotation=(0, 0, 0), scale=(1, 1, 1), **size):
    entry = {"name": name, "kind": kind, **size, "colour": colour, "position": list(position)}
    if tuple(rotation) != (0, 0, 0):
        entry["rotation_deg"] = list(rotation)
    if tuple(scale) != (1, 1, 1):
        entry["scale"] = list(scale)
    return entry


def both(make):
    """What is on the left and on the right: `make(side name, sign of x)`."""
    return [entry for name, sign in (("left", 1), ("right", -1)) for entry in make(name, sign)]


def head():
    parts = [
        solid("skull", "sphere", FUR, (0, 33, 5), scale=(1.1, 1, 1), diameter=14),
        solid("muzzle", "sphere", BELLY, (0, 30.6, 11), scale=(1.2, 0.8, 0.9), diameter=6),
        solid("nose", "triangular-pyramid", PINK, (0, 31.9, 13.5), (200, 0, 0), base=1.8, depth=1.4, height=1.2),
        solid("chin", "hemisphere", BELLY, (0, 28.7, 10.4), (180, 0, 0), diameter=4),
        solid("tongue", "cuboid", PINK, (0, 29, 12.6), (20, 0, 0), width=1.6, height=0.4, depth=2),
        solid("forehead stripe", "cuboid", DARK, (0, 39.4, 7), (-25, 0, 0), width=1, height=1.4, depth=4),
    ]
    parts += both(lambda side, x: [
        solid(f"{side} ear", "cone", FUR, (4.6 * x, 40.4, 4), (0, 0, -14 * x), scale=(1, 1, 0.6), diameter=5.6,
              height=6.4),
        solid(f"{side} inner ear", "cone", PINK, (4.6 * x, 40.1, 4.9), (0, 0, -14 * x), scale=(1, 1, 0.5),
              diameter=3.6, height=4.6),
        solid(f"{side} eye", "sphere", WHITE, (2.9 * x, 34.4, 10.6), scale=(1, 1.1, 0.7), diameter=3.2),
        solid(f"{side} iris", "sphere", EYE, (2.95 * x, 34.4, 11.3), scale=(1, 1, 0.6), diameter=2.2),
        solid(f"{side} pupil", "sphere", BLACK, (3 * x, 34.4, 11.8), scale=(0.5, 1, 0.6), diameter=1.5),
        solid(f"{side} cheek stripe", "cuboid", DARK, (7.1 * x, 32, 6), (0, 0, 10 * x), width=0.8, height=1, depth=4),
        solid(f"{side} upper whisker", "cylinder", WHITE, (5.4 * x, 31.4, 12.4), (0, 0, 82 * x), diameter=0.25,
              height=7),
        solid(f"{side} lower whisker", "cylinder", WHITE, (5.4 * x, 30.2, 12.4), (0, 0, 98 * x), diameter=0.25,
              height=7),
    ])
    return parts


def body():
    return [
        solid("neck", "frustum-cone", FUR, (0, 26.2, 3.6), (10, 0, 0), bottom_diameter=11, top_diameter=8.5, height=5),
        solid("collar", "cylinder", COLLAR, (0, 26.6, 3.8), (10, 0, 0), diameter=10.4, height=1.4),
        solid("bell", "sphere", BELL, (0, 25.2, 9.3), diameter=2.2),
        solid("buckle", "cube", BELL, (0, 26.6, -1.4), edge=1.5),
        solid("chest", "sphere", FUR, (0, 20, 2.6), (-12, 0, 0), scale=(0.95, 1.25, 0.9), diameter=14),
        solid("bib", "sphere", BELLY, (0, 19.6, 5.4), (-12, 0, 0), scale=(0.7, 1.1, 0.75), diameter=12),
        solid("belly", "sphere", FUR, (0, 12, -2), scale=(1.05, 1.1, 1.15), diameter=18),
        solid("rump", "sphere", FUR, (0, 8.6, -6), scale=(1.1, 0.9, 1), diameter=17),
        solid("first back stripe", "trapezoid", DARK, (0, 21.6, -4.4), (-64, 0, 0), bottom_width=9, bottom_depth=2,
              top_width=6, top_depth=1.4, height=1),
        solid("second back stripe", "trapezoid", DARK, (0, 17.6, -9.6), (-64, 0, 0), bottom_width=10, bottom_depth=2,
              top_width=7, top_depth=1.4, height=2.4),
        solid("third back stripe", "trapezoid", DARK, (0, 12.6, -13.4), (-80, 0, 0), bottom_width=10, bottom_depth=2,
              top_width=7, top_depth=1.4, height=1.6),
    ]


def legs():
    return both(lambda side, x: [
        solid(f"{side} shoulder", "sphere", FUR, (4.2 * x, 16.4, 4.6), scale=(0.8, 1.3, 0.9), diameter=7.6),
        solid(f"{side} foreleg", "frustum-cone", FUR, (3.8 * x, 8.2, 6.6), (-4, 0, 0), bottom_diameter=3.6,
              top_diameter=4.8, height=13),
        solid(f"{side} forepaw", "hemisphere", WHITE, (3.8 * x, 1.1, 8), scale=(1, 1, 1.3), diameter=4.6),
        solid(f"{side} thigh", "sphere", FUR, (7 * x, 7.6, -2), scale=(0.6, 1, 1.15), diameter=13),
        solid(f"{side} hind leg", "cylinder", FUR, (7.2 * x, 1.8, 3), (90, 0, 0), diameter=3.2, height=9),
        solid(f"{side} hind paw", "hemisphere", WHITE, (7.2 * x, 1.1, 8.4), scale=(1, 1, 1.25), diameter=4.4),
        solid(f"{side} middle claw", "cone", BLACK, (3.8 * x, 0.5, 11.4), (90, 0, 0), diameter=0.6, height=1.2),
        solid(f"{side} inner claw", "cone", BLACK, (2.9 * x, 0.5, 11.2), (90, 0, 0), diameter=0.6, height=1.2),
        solid(f"{side} outer claw", "cone", BLACK, (4.7 * x, 0.5, 11.2), (90, 0, 0), diameter=0.6, height=1.2),
    ])


def tail():
    places = [((0, 4, -15), -70), ((4, 3.2, -17.6), 0), ((9, 3, -17), 0), ((13, 3.4, -14), 0), ((15, 4.6, -10), 0)]
    parts = [solid(f"tail {i + 1}", "sphere", FUR if i % 2 == 0 else DARK, place, diameter=5.2 - 0.35 * i)
             for i, (place, _) in enumerate(places)]
    return parts + [solid("tail tip", "cone", WHITE, (15.6, 6.6, -8), (40, 0, 0), diameter=3.4, height=5)]


def dish():
    return [
        solid("dish", "frustum-cone", "#3060a0", (-14, 1.5, 12), bottom_diameter=7, top_diameter=10, height=3),
        solid("food", "cylinder", "#704020", (-14, 3.05, 12), diameter=8.6, height=0.4),
        solid("ball of wool", "sphere", "#c040a0", (15, 3, 10), diameter=6),
        solid("block", "cube", "#e0b020", (-15, 2, -8), (0, 30, 0), edge=4),
        solid("block's roof", "square-pyramid", "#b03030", (-15, 5.5, -8), (0, 30, 0), edge=4.4, height=3),
        solid("cushion", "cuboid", "#506090", (0, -0.6, -2), width=36, height=1.2, depth=40),
    ]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("output")
    options = parser.parse_args()
    solids = head() + body() + legs() + tail() + dish()
    lines = ",\n".join("    " + json.dumps(entry) for entry in solids)
    with open(options.output, "w", encoding="utf-8") as out:
        out.write('{\n  "solids": [\n' + lines + "\n  ]\n}\n")
    print(f"{options.output}: {len(solids)} solids")


if __name__ == "__main__":
    main()
