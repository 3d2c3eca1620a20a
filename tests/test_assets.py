"""The content-addressed store of imported files."""

import subprocess
import sys
from hashlib import sha256

import pytest

from solidtree.model.document.document import Document
from solidtree.model.document.errors import Refusal
from solidtree.model.document.nodes import Union
from solidtree.model.document.primitives import Box, ImportedMesh
from solidtree.model.project.assets import AssetStore, assets_of, default_store


@pytest.fixture
def store(tmp_path):
    return AssetStore(tmp_path / "assets")


def test_what_is_put_is_read_under_its_sha(store):
    sha = store.put(b"solid")
    assert sha == sha256(b"solid").hexdigest()
    assert store.read(sha) == b"solid" and store.has(sha)
    assert store.put(b"solid") == sha
    assert [path.name for path in store.folder.iterdir()] == [sha]


def test_a_changed_or_missing_file_is_refused(store):
    sha = store.put(b"solid")
    store.path(sha).write_bytes(b"sulid")
    with pytest.raises(Refusal, match="has changed on the disk"):
        store.read(sha)
    store.path(sha).unlink()
    assert not store.has(sha)
    with pytest.raises(Refusal, match="cannot be read: there is no such file"):
        store.read(sha)


@pytest.mark.parametrize("name", ["", "../../etc/passwd", "A" * 64, "a" * 63, "/" + "a" * 63])
def test_only_a_sha_is_a_name(store, name):
    assert not store.has(name)
    with pytest.raises(Refusal, match="names no asset"):
        store.path(name)


def test_a_failed_write_leaves_nothing(store):
    def chunks():
        yield b"half"
        raise OSError(28, "No space left on device")

    with pytest.raises(Refusal, match="the disk is full"):
        store.put_chunks(chunks())
    with pytest.raises(Refusal, match="not the file that was stored"):
        store.put_chunks([b"other"], sha256(b"one").hexdigest())
    assert list(store.folder.iterdir()) == []


def test_a_document_tells_its_assets(store):
    a, b = store.put(b"a"), store.put(b"b")
    tree = Union(children=(ImportedMesh(asset=a), Box(), ImportedMesh(asset=b), ImportedMesh(asset=a)))
    assert assets_of(Document(solids=(tree,), definitions=(ImportedMesh(asset=b),))) == {a, b}
    assert assets_of(Document(solids=(Box(),))) == set()


def test_another_process_opens_the_store_and_leaves_it(tmp_path):
    sha = default_store().put(b"shared")
    code = (
        "import sys\nfrom solidtree.model.project.assets import default_store, use_store\n"
        "use_store(sys.argv[1])\nsys.stdout.buffer.write(default_store().read(sys.argv[2]))"
    )
    done = subprocess.run([sys.executable, "-c", code, default_store().folder, sha], capture_output=True, check=True)
    assert done.stdout == b"shared"
    assert default_store().read(sha) == b"shared"


def test_the_folder_goes_with_the_process():
    code = (
        "from solidtree.model.project.assets import default_store\n"
        "store = default_store()\nstore.put(b'x')\nprint(store.folder)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    folder = done.stdout.strip()
    assert "solidtree-assets-" in folder
    assert not AssetStore(folder).folder.exists()
