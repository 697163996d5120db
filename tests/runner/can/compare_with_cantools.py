#!/usr/bin/env python3
"""Holds `fernlicht can decode` and `can encode` against cantools on random frames of every message of DBC files.

    compare_with_cantools.py FERNLICHT FOLDER_OR_FILE... [--frames N] [--seed N] [--verbose]

Decoding: random bytes, multiplexors set to values that they know in most frames, one frame in eight cut short.
Encoding: the values that cantools decoded, and values between two raw steps; each named signal present.
Prints counts; ends with 1 if anything differs that is not a difference known by name below.
"""
import argparse
import json
import math
import pathlib
import random
import re
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
        ours = run(self.options.fernlicht, "list", "--json", str(file))
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
            return None, None
        if theirs is None:
            self.count("files that cantools refuses and fernlicht reads")
            print(f"refused by cantools: {file.name}: {why}")
            return None, None
        return [json.loads(line) for line in ours.stdout.splitlines()], theirs

    @staticmethod
    def is_utf8(file):
        try:
            file.read_bytes().decode("utf-8")
            return True
        except UnicodeDecodeError:
            return False

    def compare_file(self, file):
        ours, theirs = self.load(file)
        if ours is None:
            return
        self.count("files compared")
        known = {(int(m["id"], 16), len(m["id"]) == 8): m for m in ours}
        frames = []
        for message in theirs.messages:
            mine = known.get((message.frame_id, message.is_extended_frame))
            if mine is None:
                self.count("messages that fernlicht leaves out")
                print(f"left out: {file.name}: {message.name} (0x{message.frame_id:x})")
                continue
            if message.length > 64:
                self.count("messages longer than a frame")
                continue
            if mine["name"] != message.name:
                self.differ(file, message, "name", mine["name"])
            names = [s["name"] for s in mine["signals"]]
            if sorted(names) != sorted(s.name for s in message.signals):
                self.differ(file, message, "signals", set(names) ^ {s.name for s in message.signals})
            self.compare_meaning(file, message, mine)
            self.count("messages")
            self.count("signals", len(names))
            for _ in range(self.options.frames):
                frames.append((message, random_frame(message, self.rng)))
        if frames:
            self.compare_decoding(file, frames)
            self.compare_encoding(file, frames)

    def compare_meaning(self, file, message, mine):
        cycle = message.cycle_time or 0
        if round(mine.get("cycle_s", 0) * 1000) != round(cycle):
            self.differ(file, message, "cycle time", f"{mine.get('cycle_s')} s, {message.cycle_time} ms")
        for one in mine["signals"]:
            their = message.get_signal_by_name(one["name"])
            labels = {int(k): str(v) for k, v in (their.choices or {}).items()}
            if {int(k): v for k, v in one.get("labels", {}).items()} != labels:
                self.differ(file, message, "labels", one["name"])
            for key, value in (("unit", their.unit or ""), ("comment", their.comment or "")):
                if one.get(key, "").replace("\r\n", "\n") != value.replace("\r\n", "\n"):
                    self.differ(file, message, key, f"{one['name']}: {one.get(key)!r} {value!r}")
            limits = (one.get("minimum"), one.get("maximum"))
            if limits != (None, None) and (float(limits[0]), float(limits[1])) != (float(their.minimum), float(their.maximum)):
                self.differ(file, message, "limits", f"{one['name']}: {limits} {(their.minimum, their.maximum)}")

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
        # Back through encode: the frames byte by byte.
        again = run(self.options.fernlicht, "encode", "--dbc", str(file), text=decoded.stdout)
        if again.stdout != log:
            self.count("differences: decode | encode")
            self.differences.append(f"{file.name}: decode | encode does not give the frames back: {again.stderr}")
        for (message, data), line in zip(frames, lines):
            self.count("frames decoded")
            ours = json.loads(line, parse_float=float).get("signals", {})
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

    def compare_encoding(self, file, frames):
        wanted = []
        for message, data in frames:
            try:
                values = message.decode(data, decode_choices=False, scaling=True, allow_truncated=False, allow_excess=True)
            except Exception:
                continue
            if any(isinstance(v, float) and not math.isfinite(v) for v in values.values()):
                continue
            moved = dict(values)
            for name, value in values.items():
                signal = message.get_signal_by_name(name)
                if not signal.is_float and not signal.is_multiplexer and not any(s.multiplexer_signal == name for s in message.signals):
                    moved[name] = value + signal.scale * self.rng.uniform(-0.45, 0.45)
            for chosen in (values, moved):
                try:
                    theirs = bytes(message.encode(chosen, scaling=True, padding=False, strict=False))
                except Exception as error:
                    self.count("encodings that cantools refuses: " + str(error).split(" ")[0])
                    continue
                wanted.append((message, chosen, theirs))
        text = "".join(json.dumps({"message": m.name, "id": self.log_line(m, b"").split(" ")[2].split("#")[0], "signals": v}) + "\n" for m, v, _ in wanted)
        encoded = run(self.options.fernlicht, "encode", "--lenient", "--dbc", str(file), text=text)
        refused = dict(re.findall(r"skipped: standard input:(\d+): (.*)", encoded.stderr))
        made = iter(encoded.stdout.splitlines())
        lines = ["refused: " + refused[str(n)] if str(n) in refused else next(made) for n in range(1, len(wanted) + 1)]
        for (message, values, theirs), line in zip(wanted, lines):
            self.count("frames encoded")
            self.count("values encoded", len(values))
            ours = line.split("#")[-1]
            if line.startswith("refused"):
                self.explain_refusal(file, message, values, line)
                continue
            if "##" in line:
                ours = ours[1:]
            if ours != theirs.hex().upper() + "00" * (len(ours) // 2 - len(theirs)):
                self.differ(file, message, "bytes", f"{values}: {ours} {theirs.hex()}")

    def explain_refusal(self, file, message, values, line):
        if "whose bits another one of these values needs" in line:
            self.count("frames with overlapping signals that disagree: fernlicht refuses, cantools mixes the bits")
        elif "needs" in line and "the message's length" in line:
            self.count("frames with signals beyond the message: fernlicht refuses")
        else:
            self.differ(file, message, "refused", f"{values}: {line}")


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
