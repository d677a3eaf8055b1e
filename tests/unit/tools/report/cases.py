"""What the tests of nanomap-report have in common; NANOMAP_REPORT names the launcher."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from PIL import Image


class TemporaryFolderTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)


class ProgramTest(TemporaryFolderTest):
    def run_report(self, *arguments):
        return subprocess.run([os.environ["NANOMAP_REPORT"], *map(str, arguments)], capture_output=True, text=True)

    def assert_draws(self, *arguments):
        """Without a word, and not an empty sheet."""
        out = self.folder / "picture.png"
        result = self.run_report(*arguments, "--out", out)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        with Image.open(out) as picture:
            self.assertGreaterEqual(min(picture.size), 800)
            self.assertGreater(len(picture.convert("RGB").getcolors(1 << 24)), 100)
