"""libverp by its header: cffi in ABI mode, so nothing is compiled."""

from __future__ import annotations

import operator
import os
import re
import reprlib
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Self

import cffi
import numpy as np
from numpy.typing import NDArray

_here = Path(__file__).resolve().parent


def _header() -> str:
    """verp.h without comments and the words that are for C++ and the preprocessor."""
    beside = [_here / "verp.h", _here.parents[1] / "verp.h"]
    words = next(path for path in beside if path.exists()).read_text()
    words = re.sub(r"/\*.*?\*/|#ifdef __cplusplus.*?#endif", "", words, flags=re.S)
    return re.sub(r"^#.*$", "", words, flags=re.M)


def _library() -> str:
    """VERP_LIBRARY, else the one of the build tree beside the sources, else the installed one."""
    named = os.environ.get("VERP_LIBRARY")
    built = _here.parents[4] / "build/host-release/host/apps/libverp/libverp.so.0"
    return named or (str(built) if built.exists() else "libverp.so.0")


_declared = _header()
ffi = cffi.FFI()
ffi.cdef(_declared)
try:
    lib = ffi.dlopen(_library())
except OSError as error:
    reason = str(error).partition(".  ")[0]
    raise ImportError(f"verp: {reason}: `./verp python FILE` builds it, or set VERP_LIBRARY to it") from None
if lib.verp_abi() != lib.VERP_ABI:
    raise ImportError(f"libverp has ABI {lib.verp_abi()}, this package is for {lib.VERP_ABI}")

_SCALARS = {"float": np.float32, "double": np.float64, "char": "S1"}


def dtype_of(ctype: cffi.FFI.CType) -> np.dtype:
    """The numpy type whose bytes are those of a C struct of verp.h."""
    if ctype.kind == "struct":
        fields = ctype.fields
        return np.dtype(
            {
                "names": [name for name, _ in fields],
                "formats": [dtype_of(field.type) for _, field in fields],
                "offsets": [field.offset for _, field in fields],
                "itemsize": ffi.sizeof(ctype),
            }
        )
    if ctype.kind == "array":
        if ctype.item.cname == "char":
            return np.dtype(f"S{ctype.length}")
        item = dtype_of(ctype.item)
        base, shape = (item.subdtype if item.subdtype else (item, ()))
        return np.dtype((base, (ctype.length, *shape)))
    if ctype.cname in _SCALARS:
        return np.dtype(_SCALARS[ctype.cname])
    sign = "u" if ctype.cname.startswith(("u", "unsigned")) else "i"
    return np.dtype(f"{sign}{ffi.sizeof(ctype)}")


def layout_dtype(name: str) -> np.dtype:
    """The numpy type of the controller's own bytes ("state", "params"), fields as in C++: `gait.clock_us`."""
    text = lib.verp_layout(name.encode())
    if text == ffi.NULL:
        raise VerpError(lib.VERP_BAD_ARGUMENT, f"verp_layout: there is no struct '{name}'")
    lines = ffi.string(text).decode().splitlines()
    size = int(re.search(r"(\d+) bytes", lines[0]).group(1))
    names, formats, offsets = [], [], []
    for line in lines[2:]:
        offset, kind, field = line.split()
        length = re.search(r"\[(\d+)\]$", field) if line.endswith("]") else None
        names.append(field[: length.start()] if length else field)
        kind = "S1" if kind == "char" else kind
        if length and kind == "S1":
            formats.append(f"S{length.group(1)}")
        else:
            formats.append((kind, (int(length.group(1)),)) if length else kind)
        offsets.append(int(offset))
    return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": size})


class VerpError(RuntimeError):
    """A call that failed; `status` is its verp_status."""

    def __init__(self, status: int, text: str) -> None:
        super().__init__(text)
        self.status = status


def check(status: int) -> int:
    """A call's status, if it is no error."""
    if status < 0:
        raise VerpError(status, ffi.string(lib.verp_last_error()).decode())
    return status


# Arguments to C; `what` names the call and argument in errors.


def _short(value: Any) -> str:
    return " ".join(reprlib.repr(value).split())


def whole(value: Any, what: str, least: int, most: int) -> int:
    """A whole number from `least` to `most`."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{what} is a whole number, not {_short(value)}") from None
    if least <= number <= most:
        return number
    raise ValueError(f"{what} may be {least} to {most}, not {number}")


def real(value: Any, what: str) -> float:
    """A number; whether it has to be finite, the call knows."""
    try:
        if not isinstance(value, (str, bytes)):
            return float(value)
    except (TypeError, ValueError, OverflowError):
        pass
    raise TypeError(f"{what} is a number, not {_short(value)}")


def text(value: Any, what: str) -> object:
    """Bytes that end where the text does, or null."""
    if value is None:
        return ffi.NULL
    try:
        given = os.fsencode(value)
    except (TypeError, UnicodeError):
        raise TypeError(f"{what} is a text, not {_short(value)}") from None
    if b"\0" in given:
        raise ValueError(f"{what} has a zero character in it: {_short(value)}")
    return given


def reals(value: Any, what: str, shape: tuple[int, ...] | None = None) -> NDArray[np.float64]:
    """An array of real numbers, of that shape if one is told."""
    try:
        array = np.asarray(value)
    except (TypeError, ValueError):  # rows of different lengths
        array = np.empty(0, object)
    if array.dtype.kind not in "biuf":
        raise TypeError(f"{what} is an array of real numbers, not {_short(value)}")
    if shape is not None and array.shape != shape:
        raise ValueError(f"{what} is of the shape {shape}, not {array.shape}")
    return array.astype(np.float64)


def _reader(ctype: cffi.FFI.CType, what: str) -> Callable[[Any], object] | None:
    """How to read what a user gives for an argument or field of that type; none: it is this package's own."""
    if ctype.kind == "pointer" and ctype.item.cname == "char":
        return lambda value: value if isinstance(value, ffi.CData) else text(value, what)  # for the library to fill
    if ctype.kind != "primitive":
        return None
    if ctype.cname in _SCALARS:
        return lambda value: real(value, what)
    bits = 8 * ffi.sizeof(ctype)
    least, most = (0, 2**bits - 1) if ctype.cname.startswith("u") else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    return lambda value: whole(value, what, least, most)


def _call(name: str, arguments: list[str]) -> Callable[..., int]:
    function = getattr(lib, name)
    types = ffi.typeof(function).args
    readers = [(n, r) for n, (c, a) in enumerate(zip(types, arguments)) if (r := _reader(c, f"{name}: {a}"))]

    def call(*given: object) -> int:
        if readers:
            given = list(given)
            for n, reader in readers:
                given[n] = reader(given[n])
        status = function(*given)
        return status if status >= 0 else check(status)

    return call


#: verp.h's functions that return a status, without their `verp_`: they convert the user's arguments and raise errors.
calls = SimpleNamespace()
for _name, _arguments in re.findall(r"\bint (verp_\w+)\(([^()]*)\);", _declared):
    setattr(calls, _name.removeprefix("verp_"), _call(_name, [re.split(r"[ *]+", each)[-1] for each in _arguments.split(",")]))


def fill(struct: object, call: str, values: dict[str, Any]) -> list[object]:
    """Writes a user's values into a struct's fields. What is given has to live as long as the struct is read."""
    types, kept = {name: field.type for name, field in ffi.typeof(struct[0]).fields}, []
    for name, value in values.items():
        if name not in types:
            raise TypeError(f"{call}: there is no argument '{name}'")
        value = _reader(types[name], f"{call}: {name}")(value)
        if isinstance(value, bytes):
            value = ffi.new("char[]", value)
            kept.append(value)
        setattr(struct, name, value)
    return kept


def memory(ctype: str, dtype: np.dtype) -> tuple[object, np.ndarray]:
    """A struct that stays where it is, and one record that is a view of it: nobody can take its memory away."""
    struct = ffi.new(f"{ctype} *")
    return struct, np.frombuffer(ffi.buffer(struct), dtype)


class Handle:
    """A handle of the library's. It is closed once: by close(), at the end of a `with`, or when nobody has it any more."""

    def __init__(self, handle: object, close: Callable[[object], int]) -> None:
        self._handle, self._close, self._open = handle, close, True

    def close(self) -> None:
        """Later calls, and views of its memory, raise VerpError. Of a session: ends the run; a trace becomes whole. It stays open if a callback or
        another thread is using it: that, too, raises VerpError."""
        status = self._close(self._handle)
        self._open = status == lib.VERP_BUSY
        check(status)

    def _need_open(self, call: str) -> None:
        if not self._open:
            raise VerpError(lib.VERP_BAD_HANDLE, f"{call}: this {type(self).__name__.lower()} was closed; open one")

    def __enter__(self) -> Self:
        self._need_open("with")
        return self

    def __exit__(self, *_: object) -> None:
        if self._open:
            self.close()

    def __del__(self) -> None:
        if getattr(self, "_open", False):
            self._close(self._handle)
