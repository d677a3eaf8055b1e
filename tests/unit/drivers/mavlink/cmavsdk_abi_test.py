"""Compares drivers/mavlink/cmavsdk.h with the wheel: every structure with its ctypes structure, every function with its
ctypes signature and with the library's exports.

usage: cmavsdk_abi_test.py HEADER LAYOUT_PROGRAM LIBRARY
"""

import ctypes
import re
import subprocess
import sys
from pathlib import Path

import mavsdk.logging  # noqa: F401: sets the signatures of its functions
from mavsdk import types
from mavsdk.cmavsdk_loader import _cmavsdk_lib as wheel
from mavsdk.component_type import ComponentType
from mavsdk.connection_result import ConnectionResult
from mavsdk.plugins.mavlink_direct import mavlink_direct

STRUCTURES = {
    "mavsdk_message_t": types.MavsdkMessage,
    "mavsdk_mavlink_direct_mavlink_message_t": mavlink_direct.MavlinkMessageCStruct,
}
CONSTANTS = {
    "MAVSDK_COMPONENT_TYPE_COMPANION_COMPUTER": ComponentType.COMPANION_COMPUTER,
    "MAVSDK_CONNECTION_RESULT_SUCCESS": ConnectionResult.SUCCESS,
    "MAVSDK_MAVLINK_DIRECT_RESULT_SUCCESS": mavlink_direct.MavlinkDirectResult.SUCCESS,
}
CTYPES = {
    "void": None, "int": ctypes.c_int, "double": ctypes.c_double, "bool": ctypes.c_bool,
    "std::uint8_t": ctypes.c_uint8, "std::uint32_t": ctypes.c_uint32, "const char*": ctypes.c_char_p,
    "void*": ctypes.c_void_p, "mavsdk_system_t*": ctypes.POINTER(ctypes.c_void_p),
    "std::size_t*": ctypes.POINTER(ctypes.c_size_t),
    "mavsdk_log_callback_t": mavsdk.logging.LogCallback,
    "mavsdk_intercept_json_callback_t": types.InterceptJsonCallback,
    "mavsdk_mavlink_direct_message_callback_t": mavlink_direct.MessageCallback,
    **STRUCTURES,
    **{f"{name}*": ctypes.POINTER(structure) for name, structure in STRUCTURES.items()},
}
# The wheel's Python has no use for these, and so no signature: only the callback's type and the export are compared.
UNUSED_BY_THE_WHEEL = {"mavsdk_subscribe_outgoing_messages_json", "mavsdk_unsubscribe_outgoing_messages_json"}


def ctype_of(declared: str):
    """ctypes' name of a C++ type: handles are pointers to nobody's business."""
    handle = re.fullmatch(r"mavsdk_(?:\w+_)?t", declared) and declared not in CTYPES
    return ctypes.c_void_p if handle else CTYPES[declared]


def without_names(parameters: str) -> list[str]:
    """Types of a parameter list, every parameter of which is named."""
    return [re.fullmatch(r"(.*?)\s*\w+", parameter.strip()).group(1)
            for parameter in parameters.split(",") if parameter]


def same(declared, expected) -> bool:
    return declared is expected or (declared is not None and expected is not None and
                                    getattr(declared, "_type_", declared) == getattr(expected, "_type_", expected))


def check_structures(layout_program: str) -> list[str]:
    faults = []
    layouts = {line.split()[0]: [int(number) for number in line.split()[1:]]
               for line in subprocess.check_output([layout_program], text=True).splitlines()}
    if layouts.keys() != STRUCTURES.keys():
        faults.append(f"structures {sorted(layouts)} are printed, {sorted(STRUCTURES)} are known")
    for name, structure in STRUCTURES.items():
        expected = [ctypes.sizeof(structure)] + [getattr(structure, field[0]).offset for field in structure._fields_]
        if layouts.get(name) != expected:
            faults.append(f"{name}: size and offsets {layouts.get(name)}, in the wheel {expected}")
    return faults


def check_constants(header: str) -> list[str]:
    declared = {name: int(value) for name, value in re.findall(r"enum \{ (\w+) = (\d+) \};", header)}
    return [f"constant {name}: {declared.get(name)}, in the wheel {CONSTANTS.get(name)}"
            for name in declared.keys() | CONSTANTS.keys() if declared.get(name) != CONSTANTS.get(name)]


def check_callbacks(header: str) -> list[str]:
    faults = []
    for name, result, parameters in re.findall(r"using (\w+_callback_t) = (\w+) \(\*\)\(([^)]*)\);", header):
        callback = CTYPES[name]
        if not same(ctype_of(result), callback._restype_):
            faults.append(f"{name}: returns {result}, in the wheel {callback._restype_}")
        declared = [ctype_of(parameter) for parameter in without_names(parameters)]
        if not (len(declared) == len(callback._argtypes_) and all(map(same, declared, callback._argtypes_))):
            faults.append(f"{name}: takes {declared}, in the wheel {callback._argtypes_}")
    return faults


def check_functions(header: str, library) -> list[str]:
    faults = []
    functions = re.findall(r"^([\w:]+\*?) (mavsdk_\w+)\(([^()]*)\);", header, re.MULTILINE)
    if len(functions) != len(re.findall(r"\bmavsdk_\w+\(", header)):
        faults.append("a declaration was not understood")
    for result, name, parameters in functions:
        if not hasattr(library, name):
            faults.append(f"{name}: not exported")
            continue
        if name in UNUSED_BY_THE_WHEEL:
            continue
        function = getattr(wheel, name)
        declared = [ctype_of(parameter) for parameter in without_names(parameters)]
        expected = function.argtypes
        if expected is None or len(declared) != len(expected) or not all(map(same, declared, expected)):
            faults.append(f"{name}: takes {declared}, in the wheel {expected}")
        if not same(ctype_of(result), function.restype):
            faults.append(f"{name}: returns {result}, in the wheel {function.restype}")
    return faults


def main() -> int:
    header = re.sub(r"//[^\n]*", "", Path(sys.argv[1]).read_text())
    header = re.sub(r"\n[ \t]+", " ", header)
    library = ctypes.CDLL(sys.argv[3])
    faults = (check_structures(sys.argv[2]) + check_constants(header) + check_callbacks(header) +
              check_functions(header, library))
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
