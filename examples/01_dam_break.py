"""Simulate a dam break and write a video: ``python examples/01_dam_break.py [dam_break.mp4]``."""

from __future__ import annotations

import sys
from pathlib import Path

import pbfluids as pbf
from pbfluids.video import VideoWriter


def main(path: Path, **overrides: object) -> None:
    scene = pbf.Scene.builtin("dam_break", **overrides)
    camera, params = scene.camera, scene.render_params
    with (
        pbf.Renderer(1280, 720) as renderer,
        VideoWriter(path, 1280, 720, scene.frame_rate) as video,
    ):
        for frame in scene.frames():
            video.write(renderer.render(frame.positions, camera, params))
            if frame.report is not None:
                error = 100 * frame.report.mean_density_error
                print(f"{frame.time:6.3f} s   mean density error {error:.2f} %")
    print(path)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "dam_break.mp4"))
