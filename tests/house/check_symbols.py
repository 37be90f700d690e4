#!/usr/bin/env python3
"""Finds code for newer processors outside the kernels that are picked for them at run time.
Kernels stand in namespaces named after their instruction set (renderer/simd). An inline function that a kernel's unit
compiled for more than the floor, SSE4.2, would be one definition among many: the linker takes any of them, and the
program dies on an older processor. Reads the disassembly of objects, archives or programs.
Prints one line for each function, FILE: NAME: what is wrong; exit 1 if there is any."""

import argparse
import re
import subprocess
import sys

# What stands in the mangled name of a function, or of a template's arguments.
FOR_AVX512 = "6N_AVX3"
FOR_AVX = ("6N_AVX2", FOR_AVX512)

FUNCTION = re.compile(r"^[0-9a-f]+ <(.+)>:$")
# All AVX instructions begin with v, and none of SSE does; BMI and BMI2 come with AVX2.
INSTRUCTION = re.compile(r"^\s*[0-9a-f]+:\s+(?:(?:rep|repz|repnz|lock|data16|bnd|notrack)\s+)*(\S+)\s*(.*)$")
AVX = re.compile(r"v|(?:shlx|shrx|sarx|rorx|mulx|pdep|pext|bzhi|andn|bextr|bls[ir]|blsmsk)[lq]?$")
AVX512 = re.compile(r"%zmm|%[xy]mm(?:1[6-9]|2\d|3[01])\b|%k[0-7]\b")


def findings(name, lines):
    """One for each function of a disassembly (objdump -d) that needs more than its name says."""
    function, known = "", set()
    for line in lines:
        start = FUNCTION.match(line)
        if start:
            function = start.group(1)
            continue
        match = INSTRUCTION.match(line)
        if not match or function in known:
            continue
        mnemonic, operands = match.groups()
        if AVX512.search(operands) and FOR_AVX512 not in function:
            needs = "AVX-512"
        elif AVX.match(mnemonic) and not any(part in function for part in FOR_AVX):
            needs = "AVX"
        else:
            continue
        known.add(function)
        yield f"{name}: {function}: needs {needs} ({mnemonic}) outside the namespaces of that instruction set"


def functions_of(name):
    """Disassembly without the machine's bytes, line by line."""
    with subprocess.Popen(["objdump", "-d", "--no-show-raw-insn", name], stdout=subprocess.PIPE, text=True) as objdump:
        yield from objdump.stdout
    if objdump.returncode != 0:
        sys.exit(f"objdump cannot read {name}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", help="objects, archives or programs")
    found = [finding for name in parser.parse_args().files for finding in findings(name, functions_of(name))]
    print(*found, f"{len(found)} findings", sep="\n")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
