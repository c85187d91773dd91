"""Where a context comes from, whom it disturbs and how it ends; each life in a process of its own.

The ladder of devices is seen through `fake_egl`, a libEGL whose list of devices is the test's.
"""

from __future__ import annotations

import ctypes
import re
import subprocess
from pathlib import Path

import pytest
from support.process import TIME_LIMIT, run_python

import pbfluids as pbf
from pbfluids import _core, errors
from pbfluids import render as render_module

pytestmark = pytest.mark.gl

SHOW = """
import pbfluids as pbf
with pbf.Renderer(16, 16) as renderer:
    renderer.render([[0, 0, 0]], pbf.Camera())
    print(renderer.info["platform"], "|", renderer.info["choice"], "|", renderer.software)
"""


@pytest.fixture(scope="session")
def fake_egl(tmp_path_factory):
    """Run code where EGL lists the given devices."""
    folder = tmp_path_factory.mktemp("fake_egl")
    source = Path(__file__).parents[1] / "support/fake_egl.c"
    command = ["cc", "-shared", "-fPIC", "-o", str(folder / "libEGL.so.1"), str(source), "-ldl"]
    subprocess.run(command, check=True)
    ctypes.CDLL("libEGL.so.1")
    real = re.search(r"\S+/libEGL\.so\S*", Path("/proc/self/maps").read_text())[0]

    def run(code, devices, **environment):
        environment = {"LD_LIBRARY_PATH": str(folder), "FAKE_EGL_REAL": real} | environment
        return run_python(code, FAKE_EGL_DEVICES=devices, **environment)

    return run


SERVER = "file=/dev/dri/renderD128;file=/dev/dri/renderD130,cuda=1;file=/dev/dri/renderD129,cuda=0"


@pytest.mark.parametrize(
    ("devices", "wish", "platform", "choice"),
    [
        (f"{SERVER};software", "", "EGL device 2 (/dev/dri/renderD129, CUDA 0)", "CUDA"),
        (f"{SERVER};software", "cuda:1", "EGL device 1 (/dev/dri/renderD130, CUDA 1)", "asked"),
        (f"{SERVER};software", "0", "EGL device 0 (/dev/dri/renderD128)", "asked"),
        (f"{SERVER};software", "software", "EGL device 3 (software)", "asked"),
        (f"software;{SERVER}", "hardware", "EGL device 3 (/dev/dri/renderD129, CUDA 0)", "asked"),
        (f"{SERVER};software", "surfaceless", "surfaceless", "asked"),
        ("file=/dev/dri/renderD128;software", "", "EGL device 0 (/dev/", "first hardware device"),
        ("software", "", "EGL device 0 (software)", "EGL lists no hardware device"),
        ("fails=0x3001;software", "", "EGL device 1 (software)", "no hardware device works"),
        ("fails=0x3001;software,fails=0x3003", "", "surfaceless", "no EGL device works"),
        ("", "", "surfaceless", "no EGL device works"),
    ],
)
def test_the_ladder(fake_egl, devices, wish, platform, choice):
    done = fake_egl(SHOW, devices, PBF_EGL_DEVICE=wish)
    assert done.returncode == 0, done.stderr
    shown_platform, shown_choice, software = done.stdout.strip().split(" | ")
    assert shown_platform.startswith(platform)
    assert choice in shown_choice
    assert software == "True"  # llvmpipe stands behind all of them
    if wish:
        assert f"PBF_EGL_DEVICE = {wish}" in shown_choice


def test_the_argument_goes_before_the_environment(fake_egl):
    code = SHOW.replace("16)", "16, device=0)")
    done = fake_egl(code, "file=/dev/dri/renderD128;software", PBF_EGL_DEVICE="1")
    assert done.stdout.startswith("EGL device 0 (/dev/dri/renderD128) | asked for by device = 0")


@pytest.mark.parametrize("wish", ["7", "cuda:2", "hardware"])
def test_a_device_that_is_not_there_is_refused_with_those_that_are(fake_egl, wish):
    code = """
import pbfluids as pbf
try:
    pbf.Renderer(16, 16)
except pbf.errors.RendererUnavailable as error:
    print(error)
"""
    done = fake_egl(code, "software;software", PBF_EGL_DEVICE=wish)
    assert f"PBF_EGL_DEVICE = {wish}: there is no such device; there are 2:" in done.stdout
    assert "\n  EGL device 0 (software)\n  EGL device 1 (software)" in done.stdout


@pytest.mark.parametrize("wish", ["-1", "1.5", "first", "cuda:", "Software"])
def test_a_wish_that_means_nothing_is_refused(monkeypatch, wish):
    with pytest.raises(errors.InvalidParameter, match=f"device = {wish}: must be the index"):
        pbf.Renderer(16, 16, device=wish)
    monkeypatch.setenv("PBF_EGL_DEVICE", wish)
    with pytest.raises(errors.InvalidParameter, match=f"PBF_EGL_DEVICE = {wish}: must be the"):
        pbf.Renderer(16, 16)


def test_every_attempt_is_in_the_error_in_words(fake_egl):
    code = """
import pbfluids as pbf
try:
    pbf.Renderer(16, 16, backend="egl")
except pbf.errors.RendererUnavailable as error:
    print(error)
"""
    devices = "file=/dev/dri/renderD128,fails=0x3001;software,fails=0x3003"
    hide = {"FAKE_EGL_HIDES": "EGL_MESA_platform_surfaceless"}
    done = fake_egl(code, devices, **hide, NVIDIA_VISIBLE_DEVICES="all", CONDA_PREFIX="/c")
    lines = done.stdout.splitlines()
    # What is known before any attempt stands first.
    assert lines[:4] == [
        "no OpenGL context could be made; tried in this order:",
        "  surfaceless: this EGL has no EGL_MESA_platform_surfaceless",
        "  EGL device 0 (/dev/dri/renderD128): the display cannot be opened: "
        "EGL_NOT_INITIALIZED: no driver for it could be started",
        "  EGL device 1 (software): the display cannot be opened: "
        "EGL_BAD_ALLOC: out of memory or of contexts",
    ]
    assert "apt-get install libegl1 libgl1-mesa-dri" in done.stdout
    assert "NVIDIA_DRIVER_CAPABILITIES=all" in done.stdout
    assert "libstdcxx-ng" in done.stdout


NO_DRIVER = {"__EGL_VENDOR_LIBRARY_DIRS": "/nowhere", "__EGL_VENDOR_LIBRARY_FILENAMES": ""}


@pytest.mark.parametrize("wish", ['backend="egl"', 'device="software"', "device=0"])
def test_a_driver_that_was_asked_for_and_is_not_there_is_an_error(wish):
    code = f"""
import pbfluids as pbf
try:
    pbf.Renderer(16, 16, {wish})
except pbf.errors.RendererUnavailable as error:
    print(error)
"""
    done = run_python(code, PBF_EGL_DEVICE="", **NO_DRIVER)
    if "device" in wish:
        assert "there is no such device" in done.stdout
    else:
        assert "tried in this order:\n  EGL devices: " in done.stdout
        assert "surfaceless" in done.stdout
        assert "apt-get install libegl1 libgl1-mesa-dri" in done.stdout


def test_without_a_driver_cpp_draws_and_says_why_once():
    code = """
import warnings
import pbfluids as pbf
with warnings.catch_warnings(record=True) as said:
    warnings.simplefilter("always")
    with pbf.Renderer(16, 16) as first, pbf.Renderer(16, 16) as second:
        image = first.render([[0, 0, 0]], pbf.Camera())
        print(image.shape, first.software, first.info["choice"])
with pbf.Renderer(16, 16, backend="cpu") as third:
    print((third.render([[0, 0, 0]], pbf.Camera()) == image).all())
(warning,) = said
print(warning.category.__name__, warning.message)
"""
    done = run_python(code, PBF_EGL_DEVICE="", **NO_DRIVER)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("(16, 16, 4) True there is no OpenGL\nTrue\nSoftwareRendering")
    assert "tried in this order:\n  EGL devices: " in done.stdout
    assert "apt-get install libegl1 libgl1-mesa-dri" in done.stdout
    assert 'backend="cpu"' in done.stdout


def test_on_software_cpp_draws_and_names_the_driver():
    code = """
import pbfluids as pbf
with pbf.Renderer(16, 16) as mine, pbf.Renderer(16, 16, backend="egl") as shaders:
    print(mine.software, shaders.software)
    print(mine.description)
    print(shaders.description)
"""
    done = run_python(code, PBF_EGL_DEVICE="software")
    assert done.returncode == 0, done.stderr
    software, mine, shaders = done.stdout.splitlines()
    assert software == "True True"
    assert mine == f"C++ on the processor, in place of {shaders}"


@pytest.mark.parametrize(
    "hides",
    [
        "EGL_KHR_surfaceless_context",
        "EGL_KHR_no_config_context",
        "EGL_KHR_surfaceless_context EGL_KHR_no_config_context",
    ],
)
def test_drivers_that_want_a_surface_or_a_configuration_get_one(fake_egl, hides):
    done = fake_egl(SHOW, "software", FAKE_EGL_HIDES=hides)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    "environment",
    [
        {"DISPLAY": ":99"},
        {"WAYLAND_DISPLAY": "nothing"},
        {"EGL_PLATFORM": "x11"},
        {"LIBGL_ALWAYS_SOFTWARE": "1"},
        {"HOME": "/dev/null", "XDG_CACHE_HOME": "/dev/null/cache"},  # no place for shaders
        {"MESA_SHADER_CACHE_DIR": "/proc/nowhere"},
    ],
)
def test_what_stands_in_the_environment_does_not_matter(environment):
    done = run_python(SHOW, **environment)
    assert done.returncode == 0, done.stderr
    assert done.stdout


# Software by accident


@pytest.fixture
def gpu_in_sight(monkeypatch):
    monkeypatch.setattr(_core, "visible_gpus", lambda: ["/dev/dri/renderD128"])
    monkeypatch.setattr(render_module, "_said", False)
    monkeypatch.delenv("PBF_EGL_DEVICE", raising=False)
    monkeypatch.delenv("LIBGL_ALWAYS_SOFTWARE", raising=False)


@pytest.fixture
def software():
    with pbf.Renderer(16, 16) as renderer:
        if not renderer.software:
            pytest.skip("this machine draws on a GPU")


def test_software_beside_a_gpu_is_said_aloud_once(software, gpu_in_sight):
    with pytest.warns(errors.SoftwareRendering) as said:
        pbf.Renderer(16, 16).close()
    (warning,) = said
    text = str(warning.message)
    assert "draws on the processor, although there is a GPU (/dev/dri/renderD128)" in text
    assert "EGL does not list the GPU" in text
    assert "PBF_EGL_DEVICE=software" in text
    assert warning.filename == __file__  # it points at the caller
    pbf.Renderer(16, 16).close()  # warnings are errors here


def test_software_that_was_chosen_is_not_news(software, gpu_in_sight, monkeypatch):
    pbf.Renderer(16, 16, device="software").close()
    monkeypatch.setenv("LIBGL_ALWAYS_SOFTWARE", "1")
    pbf.Renderer(16, 16).close()
    monkeypatch.delenv("LIBGL_ALWAYS_SOFTWARE")
    monkeypatch.setenv("PBF_EGL_DEVICE", "software")
    pbf.Renderer(16, 16).close()


def test_software_without_a_gpu_is_not_news(software, gpu_in_sight, monkeypatch):
    monkeypatch.setattr(_core, "visible_gpus", list)
    pbf.Renderer(16, 16).close()


def test_the_warning_says_what_became_of_the_gpu(fake_egl):
    code = """
from pbfluids import _core
_core.visible_gpus = lambda: ["/dev/dri/renderD128"]
import pbfluids as pbf
pbf.Renderer(16, 16)
"""
    done = fake_egl(code, "file=/dev/dri/renderD128,fails=0x3002;software", PBF_EGL_DEVICE="")
    assert "SoftwareRendering: C++ on the processor, in place of llvmpipe" in done.stderr
    assert "  EGL device 0 (/dev/dri/renderD128): the display cannot be opened" in done.stderr
    assert "EGL_BAD_ACCESS" in done.stderr


@pytest.mark.parametrize("threads", [1, 3])
def test_lp_num_threads_stands(threads):
    code = """
from pathlib import Path
import pbfluids as pbf
renderer = pbf.Renderer(16, 16, device="software")
names = [task.read_text() for task in Path("/proc/self/task").glob("*/comm")]
print(sum(name.startswith("llvmpipe") for name in names))
"""
    done = run_python(code, LP_NUM_THREADS=str(threads))
    assert done.stdout.strip() == str(threads), done.stderr


# Others in the process

OTHER_USER = """
import ctypes
import numpy as np
import pbfluids as pbf

egl = ctypes.CDLL("libEGL.so.1")
pointers = ["eglGetProcAddress", "eglGetPlatformDisplay", "eglCreateContext",
            "eglCreatePbufferSurface", "eglGetCurrentContext", "eglGetCurrentSurface",
            "eglGetCurrentDisplay"]
for name in pointers:
    getattr(egl, name).restype = ctypes.c_void_p
P = ctypes.c_void_p
def attributes(*values):
    return (ctypes.c_int * (len(values) + 1))(*values, 0x3038)
display = P(egl.eglGetPlatformDisplay(0x31DD, None, None))
assert egl.eglInitialize(display, None, None)
egl.eglBindAPI(0x30A2)
config, found = P(), ctypes.c_int()
egl.eglChooseConfig(display, attributes(0x3033, 1, 0x3040, 8), ctypes.byref(config), 1,
                    ctypes.byref(found))
context = P(egl.eglCreateContext(display, config, None, attributes(0x3098, 3, 0x30FB, 3)))
surface = P(egl.eglCreatePbufferSurface(display, config, attributes(0x3057, 32, 0x3056, 32)))
assert egl.eglMakeCurrent(display, surface, surface, context)
def gl(name, *types):
    return ctypes.CFUNCTYPE(None, *types)(egl.eglGetProcAddress(name.encode()))
clear_color = gl("glClearColor", *[ctypes.c_float] * 4)
clear = gl("glClear", ctypes.c_uint)
read_pixels = gl("glReadPixels", *[ctypes.c_int] * 4, ctypes.c_uint, ctypes.c_uint, P)
clear_color(1, 0, 1, 1)
def check():
    assert egl.eglGetCurrentContext() == context.value
    assert egl.eglGetCurrentSurface(0x3059) == surface.value
    assert egl.eglQueryAPI() == 0x30A2
    clear(0x4000)
    pixel = (ctypes.c_ubyte * 4)()
    read_pixels(3, 3, 1, 1, 0x1908, 0x1401, pixel)
    assert list(pixel) == [255, 0, 255, 255], list(pixel)
check()
"""


def test_another_user_of_opengl_is_not_disturbed():
    done = run_python(
        OTHER_USER
        + """
renderer = pbf.Renderer(64, 48, backend="egl")
check()
image = renderer.render([[0, 0, 0]], pbf.Camera())
check()
try:
    renderer.render([[0, 0, float("nan")]], pbf.Camera())
except pbf.FluidError:
    check()
with pbf.Renderer(16, 16, backend="egl") as second:
    check()
check()
assert np.array_equal(renderer.render([[0, 0, 0]], pbf.Camera()), image)
renderer.close()
check()
print("undisturbed")
"""
    )
    assert done.stdout == "undisturbed\n", done.stderr


def test_somebody_else_s_terminate_is_an_error_and_not_the_end():
    done = run_python(
        OTHER_USER
        + """
renderer = pbf.Renderer(16, 16, device="surfaceless", backend="egl")  # the same display
egl.eglMakeCurrent(display, None, None, None)
assert egl.eglTerminate(display)
try:
    renderer.render([[0, 0, 0]], pbf.Camera())
    print("drawn")  # drivers may keep a display that has contexts
except pbf.errors.GlError as error:
    assert "EGL_" in str(error), error
    print("refused")
renderer.close()
with pbf.Renderer(16, 16, device="surfaceless", backend="egl") as again:
    again.render([[0, 0, 0]], pbf.Camera())
"""
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() in ("drawn", "refused")


# Lives and ends


@pytest.mark.parametrize("renderers", [200, pytest.param(2000, marks=pytest.mark.slow)])
def test_renderers_that_come_and_go_leave_nothing_behind(renderers):
    code = f"""
import os, pbfluids as pbf
def held():
    pages = int(open("/proc/self/statm").read().split()[1])
    return pages * 4096 / 1e6, len(os.listdir("/proc/self/fd")), len(os.listdir("/proc/self/task"))
def make(n):
    for _ in range(n):
        with pbf.Renderer(16, 16) as r:
            r.render([[0, 0, 0]], pbf.Camera())
make({renderers // 5})
before = held()
make({renderers})
print(*(now - then for now, then in zip(held(), before)))
"""
    done = run_python(code, time_limit=10 * TIME_LIMIT)
    assert done.returncode == 0, done.stderr
    grown, files, threads = (float(word) for word in done.stdout.split())
    assert grown < 20  # MB
    assert files <= 0
    assert threads <= 0


@pytest.mark.parametrize("what", ["render", "make", "close", "devices", "repr"])
def test_after_fork_the_child_gets_an_error_and_the_parent_goes_on(what):
    code = f"""
import os, sys, pbfluids as pbf
from pbfluids import _core
renderer = pbf.Renderer(16, 16)
pid = os.fork()
if pid == 0:
    try:
        if "{what}" == "render":
            renderer.render([[0, 0, 0]], pbf.Camera())
        elif "{what}" == "make":
            pbf.Renderer(16, 16)
        elif "{what}" == "devices":
            _core.egl_devices()
        elif "{what}" == "repr":
            os._exit(3 if "OpenGL" in repr(renderer) else 6)
        else:
            renderer.close()
            os._exit(3 if renderer.closed else 6)
    except pbf.FluidError as error:
        os._exit(3 if "spawn" in str(error) else 4)
    os._exit(5)
assert os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == 3
renderer.render([[0, 0, 0]], pbf.Camera())
"""
    done = run_python(code)
    assert done.returncode == 0, done.stderr


def test_a_fork_while_another_thread_draws_does_not_hang_the_child():
    code = """
import os, threading, time, numpy as np, pbfluids as pbf
renderer = pbf.Renderer(640, 480)
cloud = np.random.default_rng(0).uniform(-1, 1, (20000, 3))
stop = threading.Event()
def draw():
    while not stop.is_set():
        renderer.render(cloud, pbf.Camera(), pbf.RenderParams(radius=0.05))
thread = threading.Thread(target=draw)
thread.start()
time.sleep(0.2)
for attempt in range(5):
    pid = os.fork()
    if pid == 0:
        errors = 0
        for call in (lambda: renderer.render(cloud, pbf.Camera()), lambda: pbf.Renderer(16, 16)):
            try:
                call()
            except pbf.FluidError:
                errors += 1
        renderer.close()
        os._exit(errors)
    assert os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == 2
    time.sleep(0.02)
stop.set()
thread.join()
"""
    done = run_python(code)
    assert done.returncode == 0, done.stderr


def test_a_child_of_multiprocessing_inherits_a_renderer_and_ends_well():
    code = """
import multiprocessing, pbfluids as pbf
renderer = pbf.Renderer(16, 16)
def work(queue):
    queue.put(len(pbf.block((0, 0, 0), (1, 1, 1), spacing=0.5)))
context = multiprocessing.get_context("fork")
queue = context.Queue()
child = context.Process(target=work, args=(queue,))
child.start()
assert queue.get(timeout=60) == 8
child.join(60)
assert child.exitcode == 0, child.exitcode
renderer.render([[0, 0, 0]], pbf.Camera())
"""
    done = run_python(code)
    assert (done.returncode, done.stderr) == (0, "")


def test_who_forks_first_may_draw_in_the_children():
    code = """
import os, pbfluids as pbf
pids = []
for _ in range(2):
    pid = os.fork()
    if pid == 0:
        with pbf.Renderer(16, 16) as renderer:
            renderer.render([[0, 0, 0]], pbf.Camera())
        os._exit(7)
    pids.append(pid)
assert [os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) for pid in pids] == [7, 7]
"""
    done = run_python(code)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    "end",
    [
        "",
        "renderer.render([[0, 0, 0]], pbf.Camera())",
        "renderer.itself = renderer",  # a cycle, for the garbage collector
        "import atexit; atexit.register(renderer.close)",
        "raise SystemExit(0)",
        "import threading; threading.Thread(target=draw_a_while).start()",
        "import threading; threading.Thread(target=draw_for_ever, daemon=True).start(); "
        "import time; time.sleep(0.3)",
    ],
)
def test_an_interpreter_may_end_with_an_open_renderer(end):
    code = f"""
import pbfluids as pbf
renderer = pbf.Renderer(64, 64)
def draw_a_while():
    for _ in range(20):
        renderer.render([[0, 0, 0]], pbf.Camera())
def draw_for_ever():
    while True:
        renderer.render([[0, 0, 0]], pbf.Camera())
{end}
"""
    done = run_python(code)
    assert (done.returncode, done.stderr) == (0, "")


def test_garbage_may_be_collected_in_another_thread():
    code = """
import gc, threading, pbfluids as pbf
gc.disable()
class Owner:
    def __init__(self):
        self.renderer = pbf.Renderer(16, 16)
        self.renderer.render([[0, 0, 0]], pbf.Camera())
        self.itself = self
kept = pbf.Renderer(16, 16)
for _ in range(5):
    Owner()
thread = threading.Thread(target=gc.collect)
thread.start()
thread.join()
kept.render([[0, 0, 0]], pbf.Camera())
print(sum(isinstance(thing, pbf.Renderer) for thing in gc.get_objects()))
"""
    done = run_python(code)
    assert (done.stdout, done.stderr) == ("1\n", "")


def test_a_renderer_that_was_not_made_says_so_once():
    done = run_python("import pbfluids as pbf; pbf.Renderer(0, 16)")
    assert done.returncode == 1
    assert done.stderr.count("Traceback") == 1
    assert "Exception ignored" not in done.stderr
