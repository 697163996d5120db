#!/usr/bin/env python3
"""Holds `fernlicht can decode` against cantools on random frames of every message of DBC files.

    compare_with_cantools.py FERNLICHT FOLDER_OR_FILE... [--frames N] [--seed N] [--verbose]

Random bytes, multiplexors set to values that they know in most frames, one frame in eight cut short.
Prints counts; ends with 1 if anything differs that is not a difference known by name below.
"""
import argparse
import json
import math
import pathlib
import random
import struct
import subprocess
import sys
import warnings

import cantools

FD_LENGTHS = list(range(9)) + [12, 16, 20, 24, 32, 48, 64]


def run(fernlicht, *arguments, text=None):
    return subprocess.run([fernlicht, "can", *arguments], input=text, capture_output=True, text=True, check=False)


def places(signal):
    """Bits of a signal from its least significant one, a third way beside the two that are compared."""
    if signal.byte_order == "little_endian":
        return list(range(signal.start, signal.start + signal.length))
    first = signal.start // 8 * 8 + 7 - signal.start % 8
    return [place // 8 * 8 + 7 - place % 8 for place in range(first, first + signal.length)][::-1]


def set_bits(data, signal, raw):
    for k, bit in enumerate(places(signal)):
        if bit // 8 < len(data):
            data[bit // 8] = data[bit // 8] & ~(1 << bit % 8) | (raw >> k & 1) << bit % 8


def value_by_hand(data, signal):
    raw = sum((data[bit // 8] >> bit % 8 & 1) << k for k, bit in enumerate(places(signal)))
    if signal.is_float:
        raw = struct.unpack(">f" if signal.length == 32 else ">d", raw.to_bytes(signal.length // 8, "big"))[0]
    elif signal.is_signed and raw >> (signal.length - 1):
        raw -= 1 << signal.length
    return raw * signal.scale + signal.offset


def random_frame(message, rng):
    data = bytearray(rng.randbytes(message.length))
    for mux in message.signals:
        ids = [i for s in message.signals if s.multiplexer_signal == mux.name for i in (s.multiplexer_ids or [])]
        if ids and rng.random() < 0.85:
            set_bits(data, mux, rng.choice(ids))
    if rng.random() < 0.125:
        data = data[: rng.randrange(len(data) + 1)]
    size = next(n for n in FD_LENGTHS if n >= len(data))
    return bytes(data) + bytes(size - len(data))


def same(a, b):
    if isinstance(a, str):
        a = float(a)
    if isinstance(a, float) and math.isnan(a):
        return isinstance(b, float) and math.isnan(b)
    return float(a) == float(b)


class Comparison:
    def __init__(self, options):
        self.options = options
        self.rng = random.Random(options.seed)
        self.counts = {}
        self.differences = []

    def count(self, what, n=1):
        self.counts[what] = self.counts.get(what, 0) + n

    def differ(self, file, message, kind, text):
        self.count("differences: " + kind)
        self.differences.append(f"{file.name}: {message.name}: {kind}: {text}")

    def load(self, file):
        """What cantools reads, where fernlicht reads the file, too."""
        ours = run(self.options.fernlicht, "decode", "--dbc", str(file), text="")
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                theirs = cantools.database.load_file(str(file), strict=False, database_format="dbc", encoding="utf-8" if self.is_utf8(file) else None)
        except Exception as error:  # cantools raises many kinds
            theirs = None
            why = str(error).split("\n")[0]
        self.count("files")
        if ours.returncode != 0:
            self.count("files that fernlicht refuses")
            print(f"refused by fernlicht{'' if theirs else ' and cantools'}: {ours.stderr.strip()}")
            return None
        if theirs is None:
            self.count("files that cantools refuses and fernlicht reads")
            print(f"refused by cantools: {file.name}: {why}")
        return theirs

    @staticmethod
    def is_utf8(file):
        try:
            file.read_bytes().decode("utf-8")
            return True
        except UnicodeDecodeError:
            return False

    def compare_file(self, file):
        theirs = self.load(file)
        if theirs is None:
            return
        self.count("files compared")
        frames = []
        for message in theirs.messages:
            if message.length > 64:
                self.count("messages longer than a frame")
                continue
            self.count("messages")
            self.count("signals", len(message.signals))
            for _ in range(self.options.frames):
                frames.append((message, random_frame(message, self.rng)))
        if frames:
            self.compare_decoding(file, frames)

    def compare_meaning(self, file, message, ours):
        if ours["message"] != message.name:
            self.differ(file, message, "name", ours["message"])
        for name, value in ours.get("signals", {}).items():
            their = message.get_signal_by_name(name)
            if ours.get("units", {}).get(name, "") != (their.unit or ""):
                self.differ(file, message, "unit", f"{name}: {ours['units'].get(name)!r} {their.unit!r}")
            raw = their.conversion.numeric_scaled_to_raw(value) if their.choices and not isinstance(value, str) else None
            label = str(their.choices[raw]) if raw is not None and raw in their.choices else None
            if ours.get("labels", {}).get(name) != label:
                self.differ(file, message, "label", f"{name} = {value}: {ours.get('labels', {}).get(name)!r} {label!r}")

    @staticmethod
    def log_line(message, data):
        identifier = f"{message.frame_id:08X}" if message.is_extended_frame else f"{message.frame_id:03X}"
        fd = message.length > 8 or message.is_fd
        return f"(0000000000.000000) can0 {identifier}#{'#0' if fd else ''}{data.hex().upper()}"

    def compare_decoding(self, file, frames):
        log = "".join(self.log_line(m, d) + "\n" for m, d in frames)
        decoded = run(self.options.fernlicht, "decode", "--dbc", str(file), "--json", text=log)
        lines = decoded.stdout.splitlines()
        if decoded.returncode != 0 or len(lines) != len(frames):
            raise SystemExit(f"{file}: decode: {decoded.returncode}, {len(lines)} of {len(frames)} lines: {decoded.stderr}")
        for (message, data), line in zip(frames, lines):
            told = json.loads(line, parse_float=float)
            if "message" not in told:
                self.count("frames of messages that fernlicht leaves out")
                continue
            self.count("frames decoded")
            self.compare_meaning(file, message, told)
            ours = told["signals"]
            try:
                theirs = message.decode(data, decode_choices=False, scaling=True, allow_truncated=True, allow_excess=True)
            except Exception as error:
                self.explain_decode_error(file, message, data, ours, error)
                continue
            self.compare_values(file, message, data, ours, theirs)

    def explain_decode_error(self, file, message, data, ours, error):
        """What cantools gives up is compared with a third, plain reading of the bits."""
        text = str(error)
        if "expected multiplexer id" in text:
            self.count("frames whose multiplexor value is unknown: cantools raises, fernlicht decodes the rest")
        elif text == "unpacking failed":
            self.count("frames of messages whose signals overlap or reach beyond it: cantools raises, fernlicht decodes")
        else:
            self.differ(file, message, "cantools raises", text)
        for name, value in ours.items():
            self.count("values compared with a plain reading")
            by_hand = value_by_hand(data, message.get_signal_by_name(name))
            if not same(value, by_hand):
                self.differ(file, message, "value", f"{name} of {data.hex()}: {value!r} {by_hand!r}")

    @staticmethod
    def follows_no_multiplexor(message, name):
        switch = message.get_signal_by_name(name).multiplexer_signal
        return switch is not None and not message.get_signal_by_name(switch).is_multiplexer

    def compare_values(self, file, message, data, ours, theirs):
        if set(theirs) < set(ours) and all(self.follows_no_multiplexor(message, name) for name in set(ours) - set(theirs)):
            self.count("frames with signals of a multiplexor marked m without a number: cantools drops them, fernlicht follows SG_MUL_VAL_")
        elif set(ours) != set(theirs):
            self.differ(file, message, "signals of a frame", f"{data.hex()}: {sorted(set(ours) ^ set(theirs))}")
        for name in set(ours) & set(theirs):
            self.count("values decoded")
            if not same(ours[name], theirs[name]):
                self.differ(file, message, "value", f"{name} of {data.hex()}: {ours[name]!r} {theirs[name]!r}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("fernlicht")
    parser.add_argument("paths", nargs="+", type=pathlib.Path)
    parser.add_argument("--frames", type=int, default=5)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    comparison = Comparison(options)
    files = []
    for path in options.paths:
        files += sorted(p for p in path.rglob("*") if p.suffix.lower() == ".dbc") if path.is_dir() else [path]
    for file in files:
        comparison.compare_file(file)
    for line in comparison.differences[: None if options.verbose else 40]:
        print("DIFFERS", line)
    for what, n in sorted(comparison.counts.items()):
        print(f"{n:9} {what}")
    return 1 if comparison.differences else 0


if __name__ == "__main__":
    sys.exit(main())
