"""libverp by its header: cffi in ABI mode, so nothing is compiled."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Self

import cffi
import numpy as np

_here = Path(__file__).resolve().parent


def _header() -> str:
    """verp.h without the words that are for C++ and the preprocessor."""
    beside = [_here / "verp.h", _here.parents[1] / "verp.h"]
    text = next(path for path in beside if path.exists()).read_text()
    text = re.sub(r"#ifdef __cplusplus.*?#endif", "", text, flags=re.S)
    return re.sub(r"^#.*$", "", text, flags=re.M)


def _library() -> str:
    """VERP_LIBRARY, else the one of the build tree beside the sources, else the installed one."""
    named = os.environ.get("VERP_LIBRARY")
    built = _here.parents[3] / "build/host-release/host/libverp/libverp.so.0"
    return named or (str(built) if built.exists() else "libverp.so.0")


ffi = cffi.FFI()
ffi.cdef(_header())
lib = ffi.dlopen(_library())
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
    if status < 0:
        raise VerpError(status, ffi.string(lib.verp_last_error()).decode())
    return status


def text(value: str | None) -> object:
    """A C string that lives as long as what is returned, or null."""
    return ffi.NULL if value is None else ffi.new("char[]", os.fsencode(value))


class Handle:
    """A handle of the library's. It is closed once: by close(), at the end of a `with`, or when nobody has it any more."""

    def __init__(self, handle: object, close: Callable[[object], int]) -> None:
        self._handle, self._close, self._open = handle, close, True

    def close(self) -> None:
        """Later calls raise VerpError. Of a session: ends the run; a trace becomes whole. It stays open if a callback or
        another thread is using it: that, too, raises VerpError."""
        status = self._close(self._handle)
        self._open = status == lib.VERP_BUSY
        check(status)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        if self._open:
            self.close()

    def __del__(self) -> None:
        if getattr(self, "_open", False):
            self._close(self._handle)
