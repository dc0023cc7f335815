#!/usr/bin/env python3
"""boards/pictures.py, and boards/qemu.py without QEMU: pictures read, compared and told apart; programs that are not
there or do not behave."""
import pathlib
import stat
import struct
import sys
import tempfile
import unittest
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "boards"))
import pictures  # noqa: E402  (lies in boards)
import qemu  # noqa: E402


def png_of(rows, width, colour_type=2):
    """A PNG whose row i is stored by filter i % 5, computed here from the specification's definitions."""
    step = 3 if colour_type == 2 else 4
    stored, above = b"", bytes(width * step)
    for i, row in enumerate(rows):
        kind = i % 5
        line = bytearray()
        for at, value in enumerate(row):
            a = row[at - step] if at >= step else 0
            b, c = above[at], above[at - step] if at >= step else 0
            p = a + b - c
            paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            line.append((value - (0, a, b, (a + b) // 2, paeth)[kind]) % 256)
        stored, above = stored + bytes([kind]) + bytes(line), row

    def chunk(name, body):
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))
    header = struct.pack(">IIBBBBB", width, len(rows), 8, colour_type, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(stored)) + chunk(b"IEND", b"")


class Pictures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        numbers, self.rows = 1, []
        for i in range(40):
            row = bytearray()
            for _ in range(7 * 3):
                numbers = numbers * 1103515245 + 12345 & 0x7FFFFFFF
                # Small numbers give predictions that are equally near.
                row.append(numbers >> 16 & (3 if i // 5 % 2 else 255))
            self.rows.append(bytes(row))
        self.picture = pictures.Picture(7, 40, b"".join(self.rows))

    def file(self, name, data):
        (self.folder / name).write_bytes(data)
        return self.folder / name

    def test_a_png_of_every_filter_is_read(self):
        self.assertEqual(pictures.read_png(self.file("a.png", png_of(self.rows, 7))), self.picture)

    def test_alpha_is_left_out(self):
        rows = [b"".join(row[i:i + 3] + b"\x80" for i in range(0, 21, 3)) for row in self.rows]
        self.assertEqual(pictures.read_png(self.file("a.png", png_of(rows, 7, colour_type=6))), self.picture)

    def test_a_damaged_png_is_refused(self):
        data = bytearray(png_of(self.rows, 7))
        data[50] ^= 1
        with self.assertRaisesRegex(ValueError, "damaged"):
            pictures.read_png(self.file("a.png", bytes(data)))
        with self.assertRaisesRegex(ValueError, "not a PNG"):
            pictures.read_png(self.file("b.png", b"P6"))

    def test_what_is_written_is_read_again(self):
        pictures.write_png(self.folder / "a.png", self.picture)
        self.assertEqual(pictures.read_png(self.folder / "a.png"), self.picture)

    def test_a_ppm_is_read_though_its_pixels_look_like_blanks(self):
        pixels = b"\n \t" + bytes(3)
        self.assertEqual(pictures.read_ppm(self.file("a.ppm", b"P6\n2 1\n255\n" + pixels)), pictures.Picture(2, 1, pixels))
        with self.assertRaisesRegex(ValueError, "needs 6 bytes"):
            pictures.read_ppm(self.file("b.ppm", b"P6\n2 1\n255\n" + pixels[:5]))

    def test_a_difference_is_told_by_its_first_pixel_and_left_to_be_looked_at(self):
        pictures.compare(self.picture, self.picture, self.folder / "none", "same")
        self.assertFalse((self.folder / "none").exists())
        other = bytearray(self.picture.rgb)
        other[3 * (4 * 7 + 2) + 1] ^= 0xFF
        other[-1] ^= 1
        actual = pictures.Picture(7, 40, bytes(other))
        with self.assertRaisesRegex(pictures.PicturesDiffer, "step: 2 pixels differ, the first at x 2, y 4: expected #"):
            pictures.compare(self.picture, actual, self.folder / "left", "step")
        self.assertEqual(pictures.read_png(self.folder / "left/step.expected.png"), self.picture)
        self.assertEqual(pictures.read_png(self.folder / "left/step.actual.png"), actual)
        with self.assertRaisesRegex(pictures.PicturesDiffer, "7x40 was expected, this is 40x7"):
            pictures.compare(self.picture, pictures.Picture(40, 7, self.picture.rgb), self.folder / "left", "size")

    def test_rgb565_loses_its_repeated_bits(self):
        shifted = pictures.shifted_565(pictures.Picture(2, 1, bytes([0xFF, 0xFF, 0xFF, 0x08, 0x04, 0x07])))
        self.assertEqual(shifted.rgb, bytes([0xF8, 0xFC, 0xF8, 0x08, 0x04, 0x00]))


class Programs(unittest.TestCase):
    def program(self, text):
        file = tempfile.NamedTemporaryFile("w", suffix=".sh", delete=False)
        self.addCleanup(pathlib.Path(file.name).unlink)
        with file:
            file.write(f"#!/bin/sh\n{text}\n")
        path = pathlib.Path(file.name)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return path

    def test_a_program_that_is_not_there_is_named(self):
        with self.assertRaisesRegex(qemu.QemuError, "qemu-system-none is not installed"):
            qemu.Qemu(["qemu-system-none"])

    def test_a_program_that_ends_at_once_is_told_with_its_last_words(self):
        with self.assertRaisesRegex(qemu.QemuError, "(?s)ended with code 3.*no such machine"):
            qemu.Qemu([self.program("echo no such machine >&2; exit 3")])

    def test_a_program_that_does_nothing_is_not_waited_for(self):
        with self.assertRaisesRegex(qemu.QemuError, "took too long"):
            qemu.Qemu([self.program("exec sleep 60")], timeout_s=0.5)


if __name__ == "__main__":
    unittest.main()
