"""Parameters in order, their users, and saved sets of values: operations, files and options of the command line."""

import json
from functools import partial

import pytest

from solidtree.model.document.document import Document, Parameter, ParameterSet
from solidtree.model.document.errors import Refusal
from solidtree.model.editing.session import Session
from solidtree.model.exchange.set_files import read_sets, write_sets
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.operations.parameter_sets import fitting_sets, set_in_force, unknown_in_set, with_texts
from solidtree.model.operations.parameters import parameter_users
from solidtree.model.script import box, document_of, parameter, save, save_sets, with_parameters, with_sets

WIDTH = parameter("width", 10, minimum=1, maximum=100)
DEPTH = parameter("depth", WIDTH / 2, maximum=40)
PLATE = document_of(plate=box(WIDTH, DEPTH, parameter("height", 3)))
WIDE = ParameterSet("wide", (("width", 60), ("height", "width / 10")))
SAVED = PLATE.with_(sets=(WIDE, ParameterSet("low", (("height", 1),))))


def do(document, name, *arguments, **keywords):
    return OPERATIONS[name](document, *arguments, **keywords)


def refused(document, words, name, *arguments):
    with pytest.raises(Refusal, match=words):
        do(document, name, *arguments)


def values(document):
    return {p.name: p.value if isinstance(p.value, float) else p.value.text for p in document.parameters}


# Order and users.


def test_a_parameter_takes_another_place_and_the_others_keep_their_order():
    names = lambda document: [p.name for p in document.parameters]  # noqa: E731
    assert names(PLATE) == ["width", "depth", "height"]
    after = do(PLATE, "reorder_parameter", "height", 0)
    assert names(after) == ["height", "width", "depth"] and after.solids is PLATE.solids
    assert all(p is PLATE.parameter(p.name) for p in after.parameters)
    assert names(do(after, "reorder_parameter", "height", 2)) == names(PLATE)
    assert do(PLATE, "reorder_parameter", "depth", 1) is PLATE
    for wrong in (3, -1, 1.5, True):
        refused(PLATE, "can stand at 0 to 2", "reorder_parameter", "depth", wrong)
    refused(PLATE, "no parameter called x", "reorder_parameter", "x", 0)


def test_users_are_reached_through_other_parameters_too():
    document = document_of(a=box(WIDTH, 1, 1), b=box(1, DEPTH, 1), c=box(1).at(0, 0, DEPTH), d=box(1))
    a, b, c, _ = (root.id for root in document.solids)
    assert parameter_users(document, "width") == (a, b, c)
    assert parameter_users(document, "depth") == (b, c)
    circle = Document(parameters=(Parameter("x", "y"), Parameter("y", "x")))
    assert parameter_users(circle, "x") == ()


# Several values at once.


def test_values_are_set_at_once_or_not_at_all():
    after = do(PLATE, "set_parameters", [("width", 20), ("height", "width / 4")])
    assert values(after) == {"width": 20, "depth": "width / 2", "height": "width / 4"}
    assert after.parameters[1] is PLATE.parameters[1] and after.solids is PLATE.solids
    assert do(PLATE, "set_parameters", [("width", 10)]) is PLATE
    refused(PLATE, "width must be at most 100", "set_parameters", [("height", 1), ("width", 101)])
    refused(PLATE, "depth must be at most 40, not 45", "set_parameters", [("width", 90)])
    refused(PLATE, "no parameter called x", "set_parameters", [("x", 1)])
    refused(PLATE, "no parameter called x", "set_parameters", [("height", "x")])
    refused(PLATE, "depends on itself", "set_parameters", [("width", "depth")])
    refused(PLATE, "given twice", "set_parameters", [("height", 1), ("height", 2)])


def test_what_was_wrong_before_does_not_stand_in_the_way():
    broken = PLATE.with_(parameters=(*PLATE.parameters, Parameter("x", "x")))
    assert values(do(broken, "set_parameters", [("width", 20)]))["width"] == 20


def test_values_are_read_as_a_command_writes_them():
    assert values(with_texts(PLATE, ["width=20", " height = width/4 ", "width=30"])) | {"depth": 0} == {
        "width": 30, "depth": 0, "height": "width/4"}  # fmt: skip
    for text in ("width", "width=", "=3", ""):
        with pytest.raises(Refusal, match="name=value"):
            with_texts(PLATE, [text])


# Sets.


def test_a_set_keeps_all_values_and_gives_them_back():
    kept = do(PLATE, "save_set", " as  it was ")
    assert [one.name for one in kept.sets] == ["as it was"] and kept.parameters is PLATE.parameters
    changed = do(do(kept, "set_parameter", "width", 30), "set_parameter", "depth", 7)
    assert set_in_force(kept) == "as it was" and set_in_force(changed) == ""
    back = do(changed, "apply_set", "as it was")
    assert values(back) == values(PLATE) and back.sets is kept.sets
    assert do(back, "apply_set", "as it was") is back
    again = do(changed, "save_set", "as it was")
    assert len(again.sets) == 1 and dict(again.sets[0].values)["width"] == 30
    assert do(again, "save_set", "as it was") is again
    refused(Document(), "no parameters", "save_set", "x")
    refused(PLATE, "needs a name", "save_set", "  ")


def test_a_set_names_some_parameters_and_the_others_keep_their_values():
    after = do(SAVED, "apply_set", "wide")
    assert values(after) == {"width": 60, "depth": "width / 2", "height": "width / 10"}
    assert values(do(after, "apply_set", "low"))["width"] == 60
    refused(SAVED, "no set .* “x”; there is “wide”, “low”", "apply_set", "x")
    refused(PLATE, "none is saved", "apply_set", "wide")


def test_a_set_out_of_range_is_refused_as_a_whole():
    tight = do(SAVED, "set_parameter", "width", 10, maximum=50)
    refused(tight, "“wide” cannot be applied: the parameter width must be at most 50", "apply_set", "wide")


def test_what_a_set_names_and_is_not_there_is_left_out():
    document = PLATE.with_(sets=(ParameterSet("old", (("gone", 5), ("width", 20), ("height", "gone"))),
                                 ParameterSet("alien", (("gone", 5),))))  # fmt: skip
    assert unknown_in_set(document, document.sets[0]) == ("gone", "height")
    assert values(do(document, "apply_set", "old")) == values(PLATE) | {"width": 20}
    refused(document, "names no parameter of this document", "apply_set", "alien")


def test_sets_are_renamed_and_deleted():
    after = do(SAVED, "rename_set", "wide", "broad")
    assert [one.name for one in after.sets] == ["broad", "low"] and after.sets[1] is SAVED.sets[1]
    assert after.sets[0].values == WIDE.values
    assert do(SAVED, "rename_set", "wide", "wide") is SAVED
    refused(SAVED, "called “low” already", "rename_set", "wide", "low")
    assert [one.name for one in do(SAVED, "delete_set", "wide").sets] == ["low"]
    refused(SAVED, "no set", "delete_set", "x")


def test_sets_follow_a_renamed_parameter_and_forget_a_deleted_one():
    after = do(SAVED, "rename_parameter", "width", "breadth")
    assert [(name, str(value)) for name, value in after.sets[0].values] == [
        ("breadth", "60.0"),
        ("height", "breadth / 10"),
    ]
    assert after.sets[1] is SAVED.sets[1]
    free = Document(parameters=(Parameter("width", 1), Parameter("height", 2)), sets=SAVED.sets)
    gone = do(free, "delete_parameter", "width")
    assert gone.sets[0].values == () and gone.sets[1] is SAVED.sets[1]  # the height was reckoned from the width


def test_every_operation_on_parameters_is_replayed_from_its_line():
    session = Session(PLATE)
    session.do("set_parameters", [("width", 20), ("height", "width / 4")])
    session.do("save_set", "one")
    session.do("put_sets", (("two", (("width", 30.0), ("height", "2 in"))),))
    session.do("apply_set", "two")
    session.do("rename_set", "one", "first")
    session.do("reorder_parameter", "height", 0)
    session.do("delete_set", "two")
    document = PLATE
    for line in session.log:
        name = line.partition("(")[0]
        document = eval(line, {name: partial(do, document, name)})
    assert document.parameters == session.document.parameters and document.sets == session.document.sets


# Files.


@pytest.mark.parametrize("ending", ["json", "csv"])
def test_sets_come_back_from_a_file(tmp_path, ending):
    path = tmp_path / f"sets.{ending}"
    sets = (*SAVED.sets, ParameterSet("Größe, “neu”", (("height", 1e-9), ("depth", 0.1 + 0.2))))
    write_sets(path, sets)
    assert read_sets(path) == sets
    save_sets(path, SAVED)
    assert with_sets(PLATE, path).sets == SAVED.sets


def test_json_is_what_openscad_writes(tmp_path):
    path = tmp_path / "sets.json"
    write_sets(path, SAVED.sets)
    assert json.loads(path.read_text(encoding="utf-8")) == {
        "parameterSets": {"wide": {"width": "60", "height": "width / 10"}, "low": {"height": "1"}},
        "fileFormatVersion": "1",
    }
    path.write_text(
        '{"parameterSets": {"first": {"$fn": "32", "width": "20.5", "lid": "true", "label": "a b", "size": "[1, 2]",'
        ' "height": 4, "none": ""}}, "fileFormatVersion": "1"}',
        encoding="utf-8",
    )
    (one,) = read_sets(path)
    assert dict(one.values) == {"$fn": 32, "width": 20.5, "lid": 1, "height": 4}
    kept, left_out = fitting_sets(PLATE, [one])
    assert kept == [ParameterSet("first", (("width", 20.5), ("height", 4)))] and left_out == ["$fn", "lid"]


def test_csv_may_come_from_a_spreadsheet(tmp_path):
    path = tmp_path / "sets.csv"
    path.write_bytes("\ufeffset;width;height\r\nlow;;2\r\n\r\nwide;80;\r\n".encode())
    assert read_sets(path) == (ParameterSet("low", (("height", 2),)), ParameterSet("wide", (("width", 80),)))


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("a.json", "{", "line 1: this is no JSON"),
        ("a.json", "[" * 100_000, "nested too deeply|no JSON"),
        ("a.json", "[]", "no “parameterSets”"),
        ("a.json", '{"parameterSets": {"a": 5}}', "“a” must be an object"),
        ("a.json", '{"parameterSets": {}, "fileFormatVersion": "2"}', "only format 1"),
        ("a.json", '{"parameterSets": {" ": {}}}', "needs a name"),
        ("a.csv", "", "first line"),
        ("a.csv", "set\nwide\n", "first line"),
        ("a.csv", "set,a\nwide,1,2\n", "row 2 has 3 cells"),
        ("a.csv", "set,a\nwide,1\nwide,2\n", "row 3: there is a set called “wide” already"),
        ("a.txt", "", "ending .json or .csv, not .txt"),
    ],
)
def test_a_broken_file_is_refused_in_words(tmp_path, name, text, words):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    with pytest.raises(Refusal, match=words):
        read_sets(path)


def test_bytes_that_are_no_text_are_refused(tmp_path):
    (tmp_path / "a.csv").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(Refusal, match="no text in UTF-8"):
        read_sets(tmp_path / "a.csv")


# Scripts and the command line.


def test_scripts_give_parameters_other_values():
    assert values(with_parameters(SAVED, "wide", height=2)) == {"width": 60, "depth": "width / 2", "height": 2}
    with pytest.raises(Refusal, match="no parameter called length"):
        with_parameters(SAVED, length=2)


def test_the_command_line_takes_sets_and_values(solidtree, tmp_path):
    path = tmp_path / "plate.solidtree"
    save(path, SAVED)
    volume = lambda *words: json.loads(solidtree("info", path, *words)[1])["total"]["volume"]  # noqa: E731
    assert volume() == pytest.approx(10 * 5 * 3)
    assert volume("--parameter", "width=20", "--parameter", "height=width/5") == pytest.approx(20 * 10 * 4)
    assert volume("--set", "wide") == pytest.approx(60 * 30 * 6)
    assert volume("--set", "wide", "--parameter", "height=1") == pytest.approx(60 * 30 * 1)
    other = tmp_path / "more.json"
    other.write_text('{"parameterSets": {"tall": {"height": "50", "lid": "1"}}, "fileFormatVersion": "1"}')
    assert volume("--sets", other, "--set", "tall") == pytest.approx(10 * 5 * 50)
    status, out, err = solidtree("export", path, tmp_path / "out.stl", "--sets", other, "--set", "tall")
    assert (status, out) == (0, "") and "lid: no such parameter" in err and (tmp_path / "out.stl").stat().st_size > 84
    status, out, _ = solidtree("sets", path)
    assert status == 0 and list(json.loads(out)["parameterSets"]) == ["wide", "low"]
    assert solidtree("sets", path, tmp_path / "sets.csv")[0] == 0 and read_sets(tmp_path / "sets.csv") == SAVED.sets


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--parameter", "width=500"], "the parameter width must be at most 100, not 500"),
        (["--parameter", "width"], "'width' gives no parameter a value"),
        (["--parameter", "length=1"], "there is no parameter called length"),
        (["--set", "x"], "there is no set of parameters called “x”; there is “wide”, “low”"),
        (["--sets", "nowhere.json"], "nowhere.json: there is no such file"),
    ],
)
def test_the_command_line_refuses_in_one_line(solidtree, tmp_path, words, message):
    path = tmp_path / "plate.solidtree"
    save(path, SAVED)
    status, out, err = solidtree("info", path, *words)
    assert status == 2 and out == "" and message in err and err.count("\n") == 1


def test_sets_cannot_be_written_just_anywhere(solidtree, tmp_path):
    path = tmp_path / "plate.solidtree"
    save(path, SAVED)
    status, _, err = solidtree("sets", path, tmp_path / "sets.txt")
    assert status == 2 and err.startswith(f"solidtree: {tmp_path / 'sets.txt'}: sets of parameters are files with")
