# SPDX-License-Identifier: GPL-3.0-or-later
"""The files of a probe sequence: one picture a frame, and beside it a record of what it shows. No bpy.

A frame is finished when its record is there and says what is wanted now: the picture is whole by then, since it gets its name only when it
is written and the record follows it. So a run that was killed goes on where it was, and several machines can share a folder.
"""

import json
import os
import shutil
import time
from dataclasses import asdict
from pathlib import Path

from . import jobs

RECORDS = "records"
# Left by a process that was killed, if it is older [s].
ABANDONED_S = 3600.0
# Part of the uncompressed size that a picture may need: the noisiest are well below.
COMPRESSED = 0.6


class SequenceFiles:
    """The files of a sequence in `folder` (a path), for frames from 0 on."""

    def __init__(self, folder, prefix="sky_"):
        self.folder = Path(folder)
        self.prefix = prefix

    def picture(self, frame):
        """Return the path of the picture of `frame`."""
        return str(self.folder / f"{self.prefix}{frame:04d}.exr")

    def prepare(self, frames, width):
        """Make the folders and check that the disk holds `frames` more pictures `width` wide; raise OSError if not."""
        records = self.folder / RECORDS
        try:
            records.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise OSError(f"folder = {self.folder}: must be one that can be made and written to ({error.strerror}); choose another") from None
        for folder in (self.folder, records):
            if not os.access(folder, os.W_OK):
                raise OSError(f"folder = {folder}: must be one that you may write to; choose another")
        for left in self.folder.glob(".skyprobe-*.part"):
            if time.time() - left.stat().st_mtime > ABANDONED_S:
                left.unlink()
        needed = frames * COMPRESSED * 12 * width * (width // 2)
        free = shutil.disk_usage(self.folder).free
        if free < needed:
            raise OSError(
                f"folder = {self.folder}: must have {needed / 1e9:.1f} GB for {frames} frames, has {free / 1e9:.1f} GB; choose another, or fewer frames"
            )

    def finished(self, frame, request):
        """Return the jobs.SkyResult of `frame` if its picture is there and shows `request`, else None."""
        try:
            content = json.loads(self._record(frame).read_text(encoding="utf-8"))
            if content["request"] != request.digest or content["size"] != os.path.getsize(self.picture(frame)):
                return None
            return jobs.result_from(content["result"], request)
        except (OSError, ValueError, KeyError, TypeError, RecursionError):
            # A damaged record is none.
            return None

    def finish(self, frame, result):
        """Note that the picture of `frame` is whole and shows `result`."""
        content = {
            "request": result.request.digest,
            "size": os.path.getsize(self.picture(frame)),
            "result": jobs.result_content(result),
            "settings": asdict(result.request),
        }
        record = self._record(frame)
        part = record.with_suffix(f".{os.getpid()}.part")
        try:
            part.write_text(json.dumps(content, indent=1), encoding="utf-8")
            os.replace(part, record)
        except OSError as error:
            raise OSError(f"{record}: cannot be written ({error.strerror}); make room, or choose another folder") from None
        finally:
            part.unlink(missing_ok=True)

    def _record(self, frame):
        return self.folder / RECORDS / f"{self.prefix}{frame:04d}.json"
