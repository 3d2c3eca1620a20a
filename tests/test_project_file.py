"""Project files: what is saved comes back, and saving is all or nothing."""

import errno
import json
import os
import shutil
import stat
import time
import zipfile
from hashlib import sha256

import pytest
from project_files import CUBE, MESH, project, sample

from solidtree.model.document.document import Document
from solidtree.model.document.errors import Refusal
from solidtree.model.document.primitives import Box, Sphere
from solidtree.model.document.table import same_document
from solidtree.model.project import project_file
from solidtree.model.project.assets import AssetStore
from solidtree.model.project.project_file import FORMAT, open_project, save_project


@pytest.fixture
def store(tmp_path):
    return AssetStore(tmp_path / "assets")


@pytest.fixture
def document(store):
    return sample(store)


def test_what_is_saved_comes_back(document, store, tmp_path):
    path = tmp_path / "plate.solidtree"
    save_project(document, path, b"\x89PNG", store)
    other = AssetStore(tmp_path / "other")
    opened = open_project(path, other)
    assert same_document(opened, document)
    assert [root.digest for root in opened.solids] == [root.digest for root in document.solids]
    assert other.read(document.solids[2].asset) == MESH
    with zipfile.ZipFile(path) as archive:
        assert archive.read("thumbnail.png") == b"\x89PNG"
        asset = archive.getinfo("assets/" + sha256(MESH).hexdigest())
        assert asset.compress_type == zipfile.ZIP_STORED
        text = archive.read("document.json").decode("utf-8")
    assert json.loads(text)["format"] == FORMAT
    assert text == json.dumps(json.loads(text), indent=2, sort_keys=True, ensure_ascii=False) + "\n"
    assert "板" in text


def test_a_document_without_meshes_holds_no_vertices(tmp_path):
    path = tmp_path / "ball.solidtree"
    save_project(Document(solids=(Sphere(id="n1", segments=400) - Box(id="n2"),)), path)
    with zipfile.ZipFile(path) as archive:
        assert archive.namelist() == ["document.json"]
        assert len(archive.read("document.json")) < 600


def test_equal_documents_make_equal_bytes(document, store, tmp_path, monkeypatch):
    a, b = tmp_path / "a.solidtree", tmp_path / "b.solidtree"
    save_project(document, a, b"png", store)
    monkeypatch.setenv("TZ", "Asia/Tokyo")
    now = time.time
    monkeypatch.setattr(time, "time", lambda: now() + 1e8)
    save_project(open_project(a, store), b, b"png", store)
    assert a.read_bytes() == b.read_bytes()


def test_a_name_with_half_a_character_is_saved(tmp_path):
    path = tmp_path / "odd.solidtree"
    save_project(Document(solids=(Box(name="a\ud800b"),)), path)
    assert open_project(path).solids[0].name == "a?b"


def test_saving_keeps_permissions_and_links(document, store, tmp_path):
    real, link = tmp_path / "real.solidtree", tmp_path / "link.solidtree"
    real.write_bytes(b"old")
    real.chmod(0o640)
    link.symlink_to(real)
    save_project(document, link, store=store)
    assert link.is_symlink() and same_document(open_project(real, store), document)
    assert stat.S_IMODE(real.stat().st_mode) == 0o640
    mask = os.umask(0o027)
    try:
        save_project(document, tmp_path / "new.solidtree", store=store)
    finally:
        os.umask(mask)
    assert stat.S_IMODE((tmp_path / "new.solidtree").stat().st_mode) == 0o640


@pytest.mark.parametrize(
    ("function", "code", "reason"),
    [
        ("replace", errno.EACCES, "permission is denied"),
        ("fsync", errno.ENOSPC, "the disk is full"),
        ("fsync", errno.EIO, "the disk reports an error"),
        ("chmod", errno.EROFS, "the disk is read-only"),
    ],
)
def test_a_save_that_fails_leaves_the_old_file(document, store, tmp_path, monkeypatch, function, code, reason):
    path = tmp_path / "work" / "plate.solidtree"
    path.parent.mkdir()
    save_project(Document(notes="old"), path)
    before = path.read_bytes()

    def fail(*_arguments, **_more):
        raise OSError(code, os.strerror(code))

    with monkeypatch.context() as patch:
        patch.setattr(os, function, fail)
        with pytest.raises(Refusal, match=f"cannot be written: {reason}"):
            save_project(document, path, store=store)
    assert path.read_bytes() == before
    assert [entry.name for entry in path.parent.iterdir()] == [path.name]


def test_a_save_without_its_mesh_is_refused(document, store, tmp_path):
    path = tmp_path / "plate.solidtree"
    path.write_bytes(b"old")
    with pytest.raises(Refusal, match=r"“Imported mesh”\): the imported file .* cannot be read"):
        save_project(document, path, store=AssetStore(tmp_path / "empty"))
    assert path.read_bytes() == b"old"


def test_places_that_cannot_be_written(document, store, tmp_path):
    with pytest.raises(Refusal, match="there is no such file or folder"):
        save_project(document, tmp_path / "no" / "plate.solidtree", store=store)
    with pytest.raises(Refusal, match="this is a folder"):
        save_project(document, tmp_path, store=store)


def test_an_older_format_is_migrated(tmp_path, monkeypatch):
    monkeypatch.setattr(project_file, "FORMAT", 2)
    monkeypatch.setitem(project_file.MIGRATIONS, 1, lambda table: {**table, "notes": "from 1"})
    path = tmp_path / "old.solidtree"
    path.write_bytes(project(CUBE))
    assert open_project(path).notes == "from 1"


def test_unknown_members_and_a_byte_order_mark_do_no_harm(tmp_path):
    path = tmp_path / "mac.solidtree"
    path.write_bytes(
        project(b"\xef\xbb\xbf" + json.dumps(CUBE).encode(), ("__MACOSX/._document.json", b"x"), ("assets/", b""))
    )
    assert open_project(path).solids[0].kind == "Box"


def test_opening_reads_no_more_than_the_file(document, store, tmp_path):
    # A file that was opened may be replaced or deleted: nothing of it is needed any more.
    path = tmp_path / "gone.solidtree"
    save_project(document, path, store=store)
    other = AssetStore(tmp_path / "other")
    opened = open_project(path, other)
    path.unlink()
    shutil.rmtree(store.folder)
    save_project(opened, path, store=other)
    assert same_document(open_project(path, other), document)
