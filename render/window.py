"""Windows of VTK: off-screen ones that need no display, and the pixels of any."""

import os
import sys
from typing import TYPE_CHECKING, Any

import numpy as np
import vtkmodules.vtkRenderingFreeType
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (registers the OpenGL classes)
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLogger, vtkUnsignedCharArray
from vtkmodules.vtkRenderingCore import vtkRenderWindow

if TYPE_CHECKING:
    from vtkmodules.vtkRenderingCore import vtkRenderer

LARGEST = 16384  # pixels a side


def offscreen_window(size: tuple[int, int], samples: int = 0) -> vtkRenderWindow:
    """A window of `size` pixels that is never shown; on Linux it does without a display (EGL, else OSMesa).

    `samples` a pixel smooth the picture, 0 for none. Call `close` when done. Raises ValueError for a size that is
    not between 1 and LARGEST.
    """
    width, height = size
    if not (1 <= width <= LARGEST and 1 <= height <= LARGEST):
        raise ValueError(f"a picture has 1 to {LARGEST} pixels a side, not {width} x {height}")
    quiet = sys.platform.startswith("linux") and not os.environ.get("DISPLAY")
    if quiet:  # VTK tries X first and complains on standard error before it takes EGL
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)
    try:
        window = vtkRenderWindow()
    finally:
        if quiet:
            vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_INFO)
    window.SetOffScreenRendering(True)
    window.SetShowWindow(False)
    window.SetMultiSamples(samples)
    window.SetAlphaBitPlanes(True)
    window.SetSize(width, height)
    return window


def native_window(window_id: int) -> vtkRenderWindow:
    """A window that draws into one that exists already, by its native id (X11 window, HWND, NSView)."""
    window = vtkRenderWindow()
    window.SetWindowInfo(str(int(window_id)))
    window.SetMultiSamples(0)
    return window


def close(window: vtkRenderWindow) -> None:
    """Free what a window holds on the graphics card."""
    window.Finalize()


def is_software(window: vtkRenderWindow) -> bool:
    """Whether a window is drawn by the processor, as with llvmpipe. Opens the window where that has not been done."""
    window.Initialize()
    capabilities = window.ReportCapabilities().lower()
    return any(name in capabilities for name in ("llvmpipe", "softpipe", "swrast", "swiftshader", "basic render"))


def smooth(window: vtkRenderWindow, renderers: "list[vtkRenderer]", samples: int, fxaa: bool) -> None:
    """Anti-alias by `samples` a pixel, or by FXAA, which software renderers do three times faster."""
    window.SetMultiSamples(samples)
    for renderer in renderers:
        renderer.SetUseFXAA(fxaa)


def pixels(window: vtkRenderWindow) -> NDArray[np.uint8]:
    """What was rendered last: (height, width, 4) bytes, first row on top."""
    width, height = window.GetSize()
    data: Any = vtkUnsignedCharArray()
    window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, data)
    return np.flipud(vtk_to_numpy(data).reshape(height, width, 4)).copy()
