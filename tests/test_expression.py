"""Expressions: what they come to, what they refuse, and that nothing typed into a field can hang the program."""

import math
import time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from solidtree.model.document.errors import Refusal
from solidtree.model.document.expression import Expression, expressions_in, number, resolved, symbolic, vector


def name(value):
    """Of a case: the values are too long, or numbers too large to write."""
    return f"{value:.12}" if isinstance(value, str) else type(value).__name__


VALUES = {"width": 10.0, "höhe": 3.0, "a": 2.0}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("width / 2 + 3", 8),
        ("2 in", 50.8),
        ("2in + 1 cm", 60.8),
        ("1.5e1 mm", 15),
        (".5 m", 500),
        ("2 mm ** 2", 4),
        ("höhe * 2", 6),
        ("-width + +a", -8),
        ("7 // 2 + 7 % 4", 6),
        ("2 ** 3 ** 2", 512),
        ("sqrt(width ** 2 - 36)", 8),
        ("hypot(3, 4)", 5),
        ("max(1, width, 3)", 10),
        ("round(2.567, 1)", 2.6),
        ("floor(2.7) + ceil(2.2)", 5),
        ("sin(90) + cos(180) + sin(180)", 0),
        ("tan(45)", pytest.approx(1)),
        ("atan2(1, 1)", pytest.approx(45)),
        ("2 * pi", math.tau),
        ("180 deg", 180),
        ("5 if width > 3 else 7", 5),
        ("5 if width == a else 7", 7),
        ("10\n+ 1", 11),
        ("+".join(["a"] * 400), 800),
    ],
)
def test_an_expression_comes_to_its_number(text, expected):
    assert Expression(text).evaluate(VALUES) == expected


NOT_ARITHMETIC = [
    "a.b", "(1).real", "__import__('os')", "[1] * 9", "lambda: 1", "f'{1}'", "a = 1", "{1}", "open(1)", "print(1)",
    "x if 1", "1;2", "a @ a", "~1", "1 and 2", "not 1", "a < 1 < 3", "min(*a)", "round(x=1)", "True", "None", "...",
    "1j", "0x10", "1 if 2else 3", "2 in (3)", "'\\d'", "a\0", "²", "(1", "1 2", "", "  ", "\\",
]  # fmt: skip


@pytest.mark.parametrize("text", NOT_ARITHMETIC)
def test_what_is_not_arithmetic_is_refused_and_never_run(text):
    with pytest.raises(Refusal):
        Expression(text)


@pytest.mark.parametrize("text", ["9**9**9", "9**9**9**9", "(floor(1e299)**999)**999", "floor(9)**floor(9)**floor(9)",
                                  "exp(exp(exp(9)))", "1e300*1e300", "1e300*1e300*0", "1e999", "1e999-1e999",
                                  "min(1e400, 5)", "round(9, 1e300)", "(" * 400 + "1" + ")" * 400, "-" * 999 + "1",
                                  "sqrt(" * 150 + "1" + ")" * 150, "1+(" * 240 + "1" + ")" * 240, "9" * 999,
                                  "9" * 100_000, "a" * 10_000_000, "1 if 1 else " * 80 + "1"], ids=name)  # fmt: skip
def test_a_bomb_is_refused_at_once(text):
    started = time.perf_counter()
    with pytest.raises(Refusal) as refusal:
        Expression(text).evaluate({})
    assert time.perf_counter() - started < 0.5
    assert len(str(refusal.value)) < 300


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("1 / 0", "divides by zero"),
        ("5 % (a - 2)", "divides by zero"),
        ("0 ** -1", "divides by zero"),
        ("tan(90)", "divides by zero"),
        ("sqrt(-1)", "has no value"),
        ("(-8) ** (1 / 3)", "root of a negative"),
        ("depth + 1", "no parameter called depth"),
        ("open", "no parameter called open"),
        ("sqrt + 1", "sqrt is a function"),
        ("2 * mm", "mm is a unit"),
        ("min(3)", "min takes two or more numbers"),
        ("sqrt(1, 2)", "sqrt takes 1 number"),
        ("sinus(3)", "no function sinus; known are abs, acos"),
        ("a ^ 2", r"write \*\* for a power"),
        ("3 $ 4", r"from “\$ 4” on"),
    ],
)
def test_a_refusal_says_what_is_wrong(text, words):
    with pytest.raises(Refusal, match=words):
        Expression(text).evaluate(VALUES)


def test_the_names_are_the_parameters_asked_for():
    assert Expression("sqrt(width) + pi * 2 mm + width").names() == {"width"}
    assert Expression("ﬁx + 1").names() == {"fix"}  # as Python reads it


def test_a_rename_leaves_alone_what_only_looks_like_the_name():
    text = Expression("e + 1e5 + ee * 2 + max(e, 3)").renamed("e", "edge").text
    assert text == "edge + 1e5 + ee * 2 + max(edge, 3)"


WIDTH, DEPTH = Expression("width"), Expression("depth")


@pytest.mark.parametrize(
    ("expression", "text"),
    [
        (WIDTH / 2 + 3, "width / 2 + 3"),
        ((WIDTH + 3) / 2, "(width + 3) / 2"),
        (WIDTH - (DEPTH - 1), "width - (depth - 1)"),
        (WIDTH / (DEPTH * 2), "width / (depth * 2)"),
        (2**WIDTH, "2 ** width"),
        ((WIDTH**2) ** DEPTH, "(width ** 2) ** depth"),
        ((-WIDTH) ** 2, "(-width) ** 2"),
        (-(WIDTH + 1), "-(width + 1)"),
        (1 - WIDTH * -2, "1 - width * (-2)"),
        (WIDTH // 3 % 2, "width // 3 % 2"),
        (Expression("2 in") * WIDTH, "2 in * width"),
        (2.5 * WIDTH, "2.5 * width"),
        (WIDTH * np.int64(2), "width * 2"),
    ],
)
def test_reckoning_with_parameters_writes_what_a_person_would(expression, text):
    assert expression.text == text


@given(st.recursive(st.sampled_from([2.0, 0.5, -3.0, "a", "b"]),
                    lambda below: st.tuples(st.sampled_from("+-*/pn"), below, below), max_leaves=12))  # fmt: skip
def test_the_text_of_a_reckoning_has_its_value(tree):
    values = {"a": 1.25, "b": -2.0}

    def reckon(node, leaf):
        if not isinstance(node, tuple):
            return leaf(node)
        sign, left, right = node[0], reckon(node[1], leaf), reckon(node[2], leaf)
        if sign == "n":
            return -left
        if sign == "p":
            return left**2
        return (
            left + right
            if sign == "+"
            else left - right
            if sign == "-"
            else left * right
            if sign == "*"
            else left / right
        )

    try:
        expected = reckon(tree, lambda leaf: values.get(leaf, leaf))
    except (ZeroDivisionError, OverflowError):
        return
    if math.isfinite(expected):
        try:
            made = reckon(tree, lambda leaf: Expression(leaf if isinstance(leaf, str) else f"{leaf}"))
        except Refusal as refusal:
            assert "characters" in str(refusal)
            return
        assert made.evaluate(values) == pytest.approx(expected)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, "nan", "inf", "-Infinity", "1e999", 10**5000, np.nan,
                                   None, True, b"5", [1], "1" * 5000], ids=name)  # fmt: skip
def test_what_is_no_finite_number_is_refused_by_name(value):
    with pytest.raises(Refusal, match=r"^Box: size") as refusal:
        number(value, "Box: size")
    assert len(str(refusal.value)) < 200
    with pytest.raises(Refusal, match=r"^Box: size"):
        vector((1, value, 3), "Box: size")


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_a_parameter_cannot_be_reckoned_with_what_is_not_finite(value):
    with pytest.raises(Refusal):
        WIDTH * value


def test_numbers_take_many_forms_and_one_value():
    for value in (5, 5.0, "5", " 5.0 ", np.float32(5), np.int64(5), Expression("5")):
        result = number(value, "x")
        assert result == 5.0 and type(result) is float
    assert math.copysign(1, number(-0.0, "x")) == 1


@pytest.mark.parametrize("value", ["123", (1, 2), (1, 2, 3, 4), 5, None])
def test_a_vector_has_three_numbers(value):
    with pytest.raises(Refusal, match="3 numbers"):
        vector(value, "Move")


def test_an_unresolved_expression_has_no_float():
    with pytest.raises(Refusal, match="no value before"):
        float(WIDTH)


def test_fields_are_resolved_inside_tuples():
    field = ((1.0, WIDTH), (WIDTH * 2, 4.0))
    assert symbolic(field) and not symbolic(((1.0,),))
    assert [e.text for e in expressions_in(field)] == ["width", "width * 2"]
    assert resolved(field, {"width": 3.0}) == ((1.0, 3.0), (6.0, 4.0))
