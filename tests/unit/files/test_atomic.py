"""Whole files or none."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

import pytest

from grainfront.errors import InputError
from grainfront.files.atomic import replacing, require_writable, write_text


def test_the_file_appears_at_the_end(tmp_path):
    path = tmp_path / "a.txt"
    with replacing(path) as temporary:
        temporary.write_text("new")
        assert not path.exists()
        assert temporary.parent == path.parent
        assert temporary.suffix == path.suffix
    assert path.read_text() == "new"
    assert list(tmp_path.iterdir()) == [path]


def test_an_error_leaves_the_old_file_and_nothing_else(tmp_path):
    path = tmp_path / "a.txt"
    write_text(path, "old")
    with pytest.raises(RuntimeError), replacing(path) as temporary:
        temporary.write_text("half")
        raise RuntimeError
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_killed_run_leaves_no_file_that_looks_finished(tmp_path):
    path = tmp_path / "a.nc"
    script = (
        "import sys, time\n"
        "from grainfront.files.atomic import replacing\n"
        "with replacing(sys.argv[1]) as temporary:\n"
        "    temporary.write_text('half')\n"
        "    print('ready', flush=True)\n"
        "    time.sleep(60)\n"
    )
    run = subprocess.Popen([sys.executable, "-c", script, str(path)], stdout=subprocess.PIPE)
    assert run.stdout.readline().strip() == b"ready"
    run.send_signal(signal.SIGKILL)
    run.communicate()
    assert not path.exists()
    assert all(p.name.startswith(".") and ".partial" in p.name for p in tmp_path.iterdir())


def test_permissions_are_those_of_an_ordinary_file(tmp_path):
    (tmp_path / "ordinary").write_text("")
    write_text(tmp_path / "ours", "")
    assert os.stat(tmp_path / "ours").st_mode == os.stat(tmp_path / "ordinary").st_mode


def test_a_missing_folder_is_named(tmp_path):
    with pytest.raises(InputError, match="nowhere does not exist"):
        write_text(tmp_path / "nowhere" / "a.txt", "")


def test_only_files_are_replaced(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    for path in (pipe, tmp_path):
        with pytest.raises(InputError, match="a folder or a device"):
            write_text(path, "")
    assert pipe.is_fifo()


def test_a_name_that_is_not_in_utf_8_is_refused(tmp_path):
    require_writable(tmp_path / "é.nc")
    with pytest.raises(InputError, match="not a name in UTF-8"):
        require_writable(os.fsdecode(os.fsencode(tmp_path) + b"/\xe9.nc"))
