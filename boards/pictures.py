"""Pictures as boards' tests meet them: screendumps of QEMU, the simulator's PNGs, and whether the two are the same."""
import pathlib
import re
import struct
import zlib
from typing import NamedTuple


class PicturesDiffer(Exception):
    """Two pictures are not the same; the text says where, and where both lie."""


class Picture(NamedTuple):
    width: int
    height: int
    rgb: bytes  # rows from the top, three bytes a pixel

    def at(self, x: int, y: int) -> tuple:
        first = 3 * (y * self.width + x)
        return tuple(self.rgb[first:first + 3])


def read_ppm(path) -> Picture:
    """A binary PPM of eight bits, as screendump writes it."""
    data = pathlib.Path(path).read_bytes()
    head = re.match(rb"P6\s+(\d+)\s+(\d+)\s+255\s", data)
    if not head:
        raise ValueError(f"{path}: not a binary PPM of eight bits")
    width, height = int(head.group(1)), int(head.group(2))
    rgb = data[head.end():]
    if len(rgb) != 3 * width * height:
        raise ValueError(f"{path}: {width}x{height} needs {3 * width * height} bytes of pixels, there are {len(rgb)}")
    return Picture(width, height, rgb)


def _unfiltered(kind: int, row: bytearray, above: bytes, step: int) -> bytearray:
    """A row of a PNG before its filter (PNG specification, chapter 9); `step` is the bytes of a pixel."""
    if kind == 1:
        for i in range(step, len(row)):
            row[i] = (row[i] + row[i - step]) & 255
    elif kind == 2:
        row = bytearray((a + b) & 255 for a, b in zip(row, above))
    elif kind == 3:
        for i in range(len(row)):
            left = row[i - step] if i >= step else 0
            row[i] = (row[i] + (left + above[i]) // 2) & 255
    elif kind == 4:
        for i in range(len(row)):
            left, up_left = (row[i - step], above[i - step]) if i >= step else (0, 0)
            up = above[i]
            d_left, d_up, d_up_left = abs(up - up_left), abs(left - up_left), abs(left + up - 2 * up_left)
            nearest = left if d_left <= d_up and d_left <= d_up_left else up if d_up <= d_up_left else up_left
            row[i] = (row[i] + nearest) & 255
    elif kind != 0:
        raise ValueError(f"filter {kind}, which PNG does not have")
    return row


def read_png(path) -> Picture:
    """A PNG of eight bits a channel, RGB or RGBA (whose alpha is left out), not interlaced, as the simulator writes."""
    data = pathlib.Path(path).read_bytes()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError(f"{path}: not a PNG")
    at, header, packed = 8, None, b""
    while at + 12 <= len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + length]
        if struct.unpack_from(">I", data, at + 8 + length)[0] != zlib.crc32(kind + body):
            raise ValueError(f"{path}: chunk {kind.decode(errors='replace')} is damaged")
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    if header is None or header[2] != 8 or header[3] not in (2, 6) or header[6] != 0:
        raise ValueError(f"{path}: only RGB and RGBA of eight bits, not interlaced, are read here; this is {header}")
    width, height, step = header[0], header[1], 3 if header[3] == 2 else 4
    raw, stride = zlib.decompress(packed), width * step
    if len(raw) != height * (stride + 1):
        raise ValueError(f"{path}: {height} rows of {stride + 1} bytes were expected, there are {len(raw)} bytes")
    above, rows = bytes(stride), []
    for y in range(height):
        first = y * (stride + 1)
        above = _unfiltered(raw[first], bytearray(raw[first + 1:first + 1 + stride]), above, step)
        rows.append(bytes(above))
    pixels = b"".join(rows)
    if step == 4:
        rgb = bytearray(3 * width * height)
        for channel in range(3):
            rgb[channel::3] = pixels[channel::4]
        pixels = bytes(rgb)
    return Picture(width, height, pixels)


def write_png(path, picture: Picture) -> None:
    def chunk(kind: bytes, body: bytes) -> bytes:
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    stride = 3 * picture.width
    rows = b"".join(b"\0" + picture.rgb[y * stride:(y + 1) * stride] for y in range(picture.height))
    header = struct.pack(">IIBBBBB", picture.width, picture.height, 8, 2, 0, 0, 0)
    pathlib.Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                                   chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def shifted_565(picture: Picture) -> Picture:
    """A picture whose RGB565 became eight bits by repeating upper bits, as QEMU's PL111 makes them: zeros below."""
    five, six = bytes(v & 0xF8 for v in range(256)), bytes(v & 0xFC for v in range(256))
    rgb = bytearray(len(picture.rgb))
    for channel, kept in enumerate((five, six, five)):
        rgb[channel::3] = picture.rgb[channel::3].translate(kept)
    return Picture(picture.width, picture.height, bytes(rgb))


def compare(expected: Picture, actual: Picture, folder, name: str) -> None:
    """Raises PicturesDiffer unless both are the same, byte for byte; leaves both in `folder`, which is made."""
    if expected == actual:
        return
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    paths = [folder / f"{name}.{which}.png" for which in ("expected", "actual")]
    for path, picture in zip(paths, (expected, actual)):
        write_png(path, picture)
    if expected[:2] != actual[:2]:
        what = f"{expected.width}x{expected.height} was expected, this is {actual.width}x{actual.height}"
    else:
        wrong = [i for i in range(0, len(expected.rgb), 3) if expected.rgb[i:i + 3] != actual.rgb[i:i + 3]]
        y, x = divmod(wrong[0] // 3, expected.width)
        what = (f"{len(wrong)} pixels differ, the first at x {x}, y {y}: expected #{bytes(expected.at(x, y)).hex()}, "
                f"actual #{bytes(actual.at(x, y)).hex()}")
    raise PicturesDiffer(f"{name}: {what}; see {paths[0]} and {paths[1]}")


def is_black(picture: Picture) -> bool:
    return not any(picture.rgb)
