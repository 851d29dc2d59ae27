#!/usr/bin/python3
"""Recounts the contributing lights of a rendered frame, independently of manylights.

    manylights render quick --frame 0 --out frame.exr --aov position,normal,depth,albedo,contributing,listed --lights frame.csv
    scripts/check_frame.py frame frame.csv

Reads STEM.position.exr, STEM.normal.exr, STEM.depth.exr and STEM.contributing.exr, counts in double precision the lights that
contribute to every pixel, and compares. A light contributes when the point is nearer to its source (a point, or a segment) than its
radius, or for a box within its faces, faces it (N.L > 0; probe lights shine from all sides) and lies in its cone. A count may differ by the lights within 1e-5 of one of
these edges, where single precision may decide otherwise.
STEM.albedo.exr and STEM.listed.exr are checked for plausibility where they are there.

Exit code 0: agreement; 1: disagreement; 2: a file is missing or not what was expected. Needs nothing but Python.
"""

import argparse
import array
import csv
import itertools
import math
import os
import struct
import sys
import zlib

MARGIN = 1e-5
TOUCHING = 1e-6  # m; nearer than this a light counts as shining along the normal
COARSE, FINE = 128, 16  # pixels a side of the blocks in which lights are ruled out


class BadFile(Exception):
    pass


def undo_zip(packed, size):
    """OpenEXR's ZIP: zlib over bytes that were split into even and odd offsets and replaced by differences."""
    if len(packed) == size:
        return packed
    deltas = zlib.decompress(packed)
    if len(deltas) != size:
        raise BadFile("a chunk has the wrong size")
    sums = itertools.accumulate(deltas, lambda before, delta: (before + delta - 128) & 255)
    planes = bytes(sums)
    half = (size + 1) // 2
    data = bytearray(size)
    data[0::2], data[1::2] = planes[:half], planes[half:]
    return bytes(data)


def read_header(data):
    if len(data) < 8 or struct.unpack_from("<I", data)[0] != 20000630:
        raise BadFile("not an OpenEXR file")
    if data[4] != 2 or data[5] & ~0x04:
        raise BadFile("not a single-part scan-line picture")
    at, attributes = 8, {}
    while data[at]:
        name_end = data.index(0, at)
        type_end = data.index(0, name_end + 1)
        size = struct.unpack_from("<I", data, type_end + 1)[0]
        attributes[data[at:name_end].decode()] = data[type_end + 5 : type_end + 5 + size]
        at = type_end + 5 + size
    return attributes, at + 1


def read_exr(path):
    """(width, height, {channel: array of floats, row by row})."""
    try:
        with open(path, "rb") as file:
            data = file.read()
    except OSError as problem:
        raise BadFile(f"{path}: {problem.strerror}") from None
    try:
        return parse_exr(data)
    except (BadFile, IndexError, KeyError, ValueError, struct.error, zlib.error) as problem:
        raise BadFile(f"{path}: expected a float OpenEXR picture: {problem}") from None


def parse_exr(data):
    attributes, at = read_header(data)
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    compression = attributes["compression"][0]
    if compression not in (0, 2, 3):
        raise BadFile("its compression is not none, ZIPS or ZIP")
    names, begin = [], 0
    while attributes["channels"][begin]:
        end = attributes["channels"].index(0, begin)
        kind, _, x_step, y_step = struct.unpack_from("<iIii", attributes["channels"], end + 1)
        names.append(attributes["channels"][begin:end].decode())
        if kind != 2 or x_step != 1 or y_step != 1:
            raise BadFile(f"channel {names[-1]} is not 32-bit float at full size")
        begin = end + 17
    pictures = {name: array.array("f", bytes(4 * width * height)) for name in names}
    lines = 16 if compression == 3 else 1
    for offset in struct.unpack_from(f"<{-(-height // lines)}Q", data, at):
        y, size = struct.unpack_from("<ii", data, offset)
        rows = min(lines, bottom - y + 1)
        raw_size = rows * width * 4 * len(names)
        chunk = data[offset + 8 : offset + 8 + size]
        raw = undo_zip(chunk, raw_size) if compression else chunk
        values = array.array("f", raw)
        if sys.byteorder == "big":
            values.byteswap()
        for row in range(rows):
            first = (y - top + row) * width
            for c, name in enumerate(names):
                begin = (row * len(names) + c) * width
                pictures[name][first : first + width] = values[begin : begin + width]
    return width, height, pictures


COLUMNS = 23


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


class Light:
    __slots__ = ("x", "y", "z", "radius", "spot", "direction", "limit", "side", "half_length", "box", "reach", "probe")

    def __init__(self, row):
        self.x, self.y, self.z, self.radius = (float(value) for value in row[1:5])
        shape = row[8]
        self.spot = {"omni": False, "spot": True, "capsule": False, "wedge": True, "box": False}[shape]
        self.direction = tuple(float(value) for value in row[9:12])
        self.limit = float(row[13])  # 1 - cos of the cone's outer angle
        self.side = tuple(float(value) for value in row[15:18])
        self.half_length = float(row[18])
        self.probe = {"0": False, "1": True}[row[22]]
        self.box = None
        if shape == "box":
            axes = (self.side, cross(self.direction, self.side), self.direction)
            self.box = tuple(zip(axes, (float(value) for value in row[19:22])))
        # The ball around the position that holds the light's volume.
        self.reach = math.sqrt(sum(extent * extent for _, extent in self.box)) if self.box else self.half_length + self.radius

    def nearest(self, dx, dy, dz):
        """The offset to the centre made one to the nearest point of the source, and how far along the source that is."""
        if not self.half_length:
            return dx, dy, dz, 0.0
        sx, sy, sz = self.side
        along = max(-self.half_length, min(self.half_length, -(dx * sx + dy * sy + dz * sz)))
        return dx + along * sx, dy + along * sy, dz + along * sz, abs(along)

    def within(self, dx, dy, dz, distance, lever):
        """Whether the point is within the light's radius or faces, and whether it is at one; (False, False) when clearly outside."""
        if not self.box:
            slack = MARGIN * (self.radius + lever)
            return distance < self.radius, abs(distance - self.radius) <= slack
        inside, near = True, False
        for (ax, ay, az), extent in self.box:
            beyond = abs(dx * ax + dy * ay + dz * az) - extent
            at_face = abs(beyond) <= MARGIN * max(extent, distance)
            if beyond >= 0 and not at_face:
                return False, False
            inside, near = inside and beyond < 0, near or at_face
        return inside, near


def read_lights(path):
    try:
        with open(path, newline="") as file:
            rows = list(csv.reader(file))
        if not rows or rows[0][0] != "index" or len(rows[0]) != COLUMNS:
            raise ValueError("line 1 is not the header")
        return [Light(row) for row in rows[1:]]
    except OSError as problem:
        raise BadFile(f"{path}: {problem.strerror}") from None
    except (ValueError, KeyError, IndexError) as problem:
        raise BadFile(f"{path}: expected a table of lights: {problem}") from None


def near_lights(lights, points):
    """The lights whose sphere, a little larger, reaches the box around the points."""
    low = [min(p[k] for p in points) for k in range(3)]
    high = [max(p[k] for p in points) for k in range(3)]
    (x0, y0, z0), (x1, y1, z1) = low, high
    kept = []
    for light in lights:
        x = x0 - light.x if light.x < x0 else light.x - x1 if light.x > x1 else 0.0
        y = y0 - light.y if light.y < y0 else light.y - y1 if light.y > y1 else 0.0
        z = z0 - light.z if light.z < z0 else light.z - z1 if light.z > z1 else 0.0
        reach = light.reach * (1 + 10 * MARGIN)
        if x * x + y * y + z * z <= reach * reach:
            kept.append(light)
    return kept


def count(point, normal, lights):
    """(contributing, how many lights are at an edge)."""
    contributing = marginal = 0
    px, py, pz = point
    nx, ny, nz = normal
    for light in lights:
        dx, dy, dz, lever = light.nearest(light.x - px, light.y - py, light.z - pz)
        distance = math.sqrt(dx * dx + dy * dy + dz * dz)
        inside, edge = light.within(dx, dy, dz, distance, lever)
        if not (inside or edge):
            continue
        # Of the direction: single precision knows it the less the longer the way along the source is.
        margin = MARGIN * (1 + lever / distance) if lever and distance else math.inf if lever else MARGIN
        if distance < TOUCHING:
            distance, dx, dy, dz = 0.0, nx, ny, nz
        else:
            dx, dy, dz = dx / distance, dy / distance, dz / distance
        facing = nx * dx + ny * dy + nz * dz
        if not light.probe:
            if facing < -margin:
                continue
            inside, edge = inside and facing > 0, edge or facing <= margin
        if light.spot:
            cosine = -(dx * light.direction[0] + dy * light.direction[1] + dz * light.direction[2])
            within = light.limit - (1 - cosine)
            in_cone, at_cone = within > 0, abs(within) <= margin
            if not in_cone and not at_cone:
                continue
            inside, edge = inside and in_cone, edge or at_cone
        contributing += inside
        marginal += edge
    return contributing, marginal


def blocks(width, height, size, left=0, top=0):
    for y in range(top, height, size):
        for x in range(left, width, size):
            yield x, y, min(x + size, width), min(y + size, height)


class Frame:
    def __init__(self, stem):
        self.stem = stem
        self.width, self.height, position = read_exr(f"{stem}.position.exr")
        self.position = self.channels("position", position, "XYZ")
        self.normal = self.channels("normal", self.read("normal"), "XYZ")
        self.depth = self.channels("depth", self.read("depth"), "Y")[0]
        self.contributing = self.channels("contributing", self.read("contributing"), "Y")[0]

    def read(self, name):
        width, height, pictures = read_exr(f"{self.stem}.{name}.exr")
        if (width, height) != (self.width, self.height):
            raise BadFile(f"{self.stem}.{name}.exr: expected {self.width}x{self.height} pixels, found {width}x{height}")
        return pictures

    def has(self, name):
        return os.path.exists(f"{self.stem}.{name}.exr")

    def channels(self, name, pictures, wanted):
        if sorted(pictures) != sorted(wanted):
            raise BadFile(f"{self.stem}.{name}.exr: expected channels {', '.join(wanted)}, found {', '.join(pictures)}")
        return [pictures[channel] for channel in wanted]

    def lit(self, x0, y0, x1, y1, step):
        """Pixels with a surface in the rectangle that the step does not leave out."""
        for y in range(-(-y0 // step) * step, y1, step):
            for x in range(-(-x0 // step) * step, x1, step):
                if self.depth[y * self.width + x] > 0:
                    yield y * self.width + x

    def point(self, i):
        return tuple(plane[i] for plane in self.position)


class Report:
    """Disagreements, the first few in full."""

    def __init__(self, frame):
        self.frame, self.wrong = frame, 0

    def add(self, i, text):
        self.wrong += 1
        if self.wrong <= 10:
            print(f"pixel ({i % self.frame.width}, {i // self.frame.width}): {text}")


def check_counts(frame, lights, step, report):
    checked = total = excused = 0
    for x0, y0, x1, y1 in blocks(frame.width, frame.height, COARSE):
        points = [frame.point(i) for i in frame.lit(x0, y0, x1, y1, step)]
        if not points:
            continue
        coarse = near_lights(lights, points)
        for u0, v0, u1, v1 in blocks(x1, y1, FINE, x0, y0):
            pixels = list(frame.lit(u0, v0, u1, v1, step))
            if not pixels:
                continue
            points = [frame.point(i) for i in pixels]
            fine = near_lights(coarse, points)
            for i, point in zip(pixels, points):
                contributing, marginal = count(point, tuple(plane[i] for plane in frame.normal), fine)
                found = frame.contributing[i]
                checked, total = checked + 1, total + contributing
                if found == contributing:
                    continue
                if abs(found - contributing) <= marginal:
                    excused += 1
                else:
                    report.add(i, f"{found:g} contributing lights in the file, {contributing} recounted, {marginal} at an edge")
    mean = total / checked if checked else 0.0
    print(f"{checked} pixels with a surface, {mean:.3f} contributing lights each; {excused} differ by lights at an edge only")


def check_plausible(frame, step, report):
    """What needs no lights: sky is unlit, normals have length 1, albedo is in [0, 1], a list is no shorter than what it must hold."""
    albedo = frame.channels("albedo", frame.read("albedo"), "RGB") if frame.has("albedo") else []
    listed = frame.channels("listed", frame.read("listed"), "Y")[0] if frame.has("listed") else None
    for y in range(0, frame.height, step):
        for i in range(y * frame.width, (y + 1) * frame.width, step):
            if not frame.depth[i] > 0:
                if frame.contributing[i] > 0:
                    report.add(i, f"sky with {frame.contributing[i]:g} contributing lights")
                continue
            length = math.sqrt(sum(plane[i] ** 2 for plane in frame.normal))
            if not abs(length - 1) < 1e-3:
                report.add(i, f"the normal has length {length:g}")
            if not all(0 <= plane[i] <= 1 for plane in albedo):
                report.add(i, f"the albedo is {', '.join(f'{plane[i]:g}' for plane in albedo)}")
            if listed is not None and not listed[i] >= frame.contributing[i]:
                report.add(i, f"{listed[i]:g} lights listed, {frame.contributing[i]:g} contribute")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("stem", help="path of the frame's EXR files without .position.exr")
    parser.add_argument("lights", help="the frame's lights as CSV")
    parser.add_argument("--step", type=int, default=1, help="check every STEP-th pixel of every STEP-th row")
    arguments = parser.parse_args()
    if arguments.step < 1:
        parser.error("--step must be at least 1")
    try:
        frame, lights = Frame(arguments.stem), read_lights(arguments.lights)
        report = Report(frame)
        check_plausible(frame, arguments.step, report)
        check_counts(frame, lights, arguments.step, report)
    except BadFile as problem:
        print(f"check_frame: {problem}", file=sys.stderr)
        return 2
    print(f"{len(lights)} lights; " + (f"{report.wrong} DISAGREEMENTS" if report.wrong else "everything agrees"))
    return 1 if report.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
