# SPDX-License-Identifier: BSL-1.0
"""Compiles the C texts of a package, and calls the library. It knows the table of dalembert_plant.h, and no model."""

from __future__ import annotations

import ctypes as C
import os
import platform
import shlex
import subprocess
import tempfile
import zlib
from pathlib import Path

PLANT_VERSION = 1
DOUBLES = C.POINTER(C.c_double)
SIZES = C.POINTER(C.c_size_t)


class PlantError(RuntimeError):
    """The library of a plant cannot be made, loaded or used."""


class CQuantity(C.Structure):
    _fields_ = [("name", C.c_char_p), ("unit", C.c_char_p), ("description", C.c_char_p), ("low", C.c_double), ("high", C.c_double)]


class CGuard(C.Structure):
    _fields_ = [("name", C.c_char_p), ("doc", C.c_char_p), ("ends", C.c_int)]


class CConstraint(C.Structure):
    _fields_ = [("name", C.c_char_p), ("unit", C.c_char_p), ("description", C.c_char_p), ("has_position", C.c_int),
                ("can_be_left_out", C.c_int), ("solved_for_at_start", C.c_int)]


class CPattern(C.Structure):
    _fields_ = [("column_starts", SIZES), ("row_indices", SIZES)]


class CPlant(C.Structure):
    """The beginning of dalembert_plant: its data, and the functions that make instances. All else is called through python.c."""

    _fields_ = [
        ("version", C.c_int), ("size", C.c_size_t),
        ("name", C.c_char_p), ("scene", C.c_char_p), ("title", C.c_char_p),
        ("states", C.c_size_t), ("inputs", C.c_size_t), ("outputs", C.c_size_t), ("parameters", C.c_size_t),
        ("degrees", C.c_size_t), ("velocity_place", C.c_size_t),
        ("guards", C.c_size_t), ("kinks", C.c_size_t), ("constraints", C.c_size_t), ("modes", C.c_size_t), ("events", C.c_size_t),
        ("state_table", C.POINTER(CQuantity)), ("input_table", C.POINTER(CQuantity)), ("output_table", C.POINTER(CQuantity)),
        ("parameter_table", C.POINTER(CQuantity)), ("guard_table", C.POINTER(CGuard)), ("constraint_table", C.POINTER(CConstraint)),
        ("mode_names", C.POINTER(C.c_char_p)), ("event_names", C.POINTER(C.c_char_p)),
        ("parameter_defaults", DOUBLES), ("start_values", DOUBLES),
        ("is_separable", C.c_int), ("is_projected", C.c_int), ("constraint_rank", C.c_size_t), ("series_rows", C.c_size_t),
        ("most_transitions", C.c_size_t),
        ("pattern_x", CPattern), ("pattern_u", CPattern), ("pattern_p", CPattern),
        ("create", C.CFUNCTYPE(C.c_void_p)), ("destroy", C.CFUNCTYPE(None, C.c_void_p)),
        ("set_parameters", C.CFUNCTYPE(None, C.c_void_p, C.c_void_p)), ("start_state", C.CFUNCTYPE(None, C.c_void_p, C.c_void_p)),
    ]


class CPoints(C.Structure):
    _fields_ = [("count", C.c_size_t), ("mode", C.c_void_p), ("mode_step", C.c_size_t), ("x", C.c_void_p), ("x_step", C.c_size_t),
                ("u", C.c_void_p), ("u_step", C.c_size_t), ("t", C.c_void_p), ("t_step", C.c_size_t)]


INPUT = C.CFUNCTYPE(None, C.c_void_p, C.c_double, DOUBLES, DOUBLES)
ASK = C.CFUNCTYPE(C.c_int, C.c_void_p)


class CEvent(C.Structure):
    _fields_ = [("t", C.c_double), ("event", C.c_size_t), ("before", C.c_uint), ("after", C.c_uint)]


class CRecord(C.Structure):
    _fields_ = [("times", C.c_void_p), ("count", C.c_size_t), ("x", C.c_void_p), ("mode", C.c_void_p), ("ask", ASK), ("ask_context", C.c_void_p),
                ("filled", C.c_size_t), ("events", C.POINTER(CEvent)), ("event_count", C.c_size_t), ("event_room", C.c_size_t),
                ("is_full", C.c_int)]


class CCall(C.Structure):
    _fields_ = [("parameters", C.c_void_p), ("x", C.c_void_p), ("scale", C.c_void_p), ("method", C.c_int), ("tolerance", C.c_double),
                ("longest_step", C.c_double), ("first_step", C.c_double), ("most_steps", C.c_size_t), ("stops", C.c_void_p),
                ("stop_count", C.c_size_t), ("input", INPUT), ("held", C.c_void_p),
                ("t", C.c_double), ("end", C.c_void_p), ("mode", C.c_uint), ("steps", C.c_size_t), ("rejected", C.c_size_t),
                ("rhs_calls", C.c_size_t), ("jacobians", C.c_size_t), ("implicit_steps", C.c_size_t), ("message", C.c_char * 512)]


def compiler() -> list[str]:
    """The C compiler with its options: $CC, or cc."""
    return shlex.split(os.environ.get("CC", "")) or ["cc"]


def library_name() -> str:
    """One for each kind of machine: a folder may serve several."""
    return f"plant-{platform.system()}-{platform.machine()}.so".lower()


def checksum(folder: Path) -> int:
    """Of the C texts that a library is made from."""
    sum_of_all = 0
    for path in sorted(folder.glob("*.[ch]")):
        sum_of_all = zlib.crc32(path.read_bytes(), sum_of_all)
    return sum_of_all


def compile_plant(folder: Path, library: Path) -> None:
    """Compiles plant.c and what it includes. The library appears whole or not at all."""
    made = library.with_name(f"{library.name}.{os.getpid()}")
    command = [*compiler(), "-std=c99", "-O2", "-fPIC", "-shared", "-fvisibility=hidden", f"-DDALEMBERT_TEXTS={checksum(folder)}u",
               "-o", str(made), str(folder / "plant.c"), "-lm"]
    try:
        run = subprocess.run(command, capture_output=True, text=True)
    except OSError as error:
        raise PlantError(f"the C compiler '{command[0]}' cannot be started ({error.strerror}); $CC names another one") from None
    if run.returncode != 0:
        made.unlink(missing_ok=True)
        raise PlantError(f"the C compiler refuses '{shlex.join(command)}':\n{run.stderr}")
    os.replace(made, library)


def places(folder: Path) -> list[Path]:
    """Where the library may be: beside the package, else in the user's cache."""
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "dalembert" / "python"
    return [folder / library_name(), cache / f"{folder.parent.name}-{checksum(folder):08x}-{library_name()}"]


def opened(path: Path, texts: int) -> C.CDLL | None:
    """The library, if this machine can load it and it was made from these texts."""
    try:
        library = C.CDLL(str(path))
        return library if library.dalembert_python_texts() & 0xFFFFFFFF == texts else None
    except (OSError, AttributeError):
        return None


def load(folder: Path) -> C.CDLL:
    """The library of the C texts in `folder`: the one that is there, or compiled now."""
    texts = checksum(folder)
    for path in places(folder):
        if path.exists() and (library := opened(path, texts)) is not None:
            return declared(library)
    for path in places(folder):
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            with tempfile.NamedTemporaryFile(dir=path.parent):
                pass
        except OSError:
            continue  # not ours to write
        compile_plant(folder, path)
        if (library := opened(path, texts)) is None:
            raise PlantError(f"'{path}' was compiled, but cannot be loaded: does '{compiler()[0]}' compile for this machine?")
        return declared(library)
    raise PlantError(f"neither '{folder}' nor the user's cache can be written: there is no place for the compiled library")


def declared(library: C.CDLL) -> C.CDLL:
    """Tells ctypes the types of the functions."""
    library.dalembert_plant_table.restype = C.POINTER(CPlant)
    version = library.dalembert_plant_table().contents.version
    if version != PLANT_VERSION:
        raise PlantError(f"the library has version {version} of the table of plants, but this package reads version {PLANT_VERSION}")
    library.dalembert_python_size.restype = C.c_size_t
    library.dalembert_python_size.argtypes = [C.c_int]
    library.dalembert_python_has.argtypes = [C.c_int]
    library.dalembert_python_many.restype = None
    library.dalembert_python_many.argtypes = [C.c_void_p, C.c_int, C.c_void_p, C.c_void_p]
    library.dalembert_python_run.argtypes = [C.POINTER(CCall), C.POINTER(CRecord)]
    library.dalembert_python_free.restype = None
    library.dalembert_python_free.argtypes = [C.POINTER(CRecord)]
    return library
