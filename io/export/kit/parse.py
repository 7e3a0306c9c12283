"""GLSL to a tree with types: the part of the language that the level's shaders use, and nothing else."""

from __future__ import annotations

from ....level import BadInput
from .lex import Word, words
from .meaning import Scope, binary_type, call_type, field_type
from .tree import Expr, Function, Statement, Struct, Unit, Variable, base, width

VECTORS = {f"{k}vec{n}" for k in ("", "i", "u", "b") for n in (2, 3, 4)}
BUILT_IN = {"void", "float", "int", "uint", "bool", "sampler2D", *VECTORS}
ASSIGN = {"=", "+=", "-=", "*=", "/=", "|=", "&="}
LEVELS = (
    ("||",), ("&&",), ("|",), ("^",), ("&",), ("==", "!="), ("<", ">", "<=", ">="), ("<<", ">>"), ("+", "-"),
    ("*", "/", "%"),
)  # fmt: skip


def parse(text: str) -> Unit:
    """The tree of a text without directives; BadInput with the line for what isn't known."""
    return _Parser(words(text)).unit()


class _Parser:
    def __init__(self, found: list[Word]) -> None:
        self.words, self.at, self.scope = found, 0, Scope()

    # words

    @property
    def now(self) -> Word:
        return self.words[self.at]

    def ahead(self, text: str) -> bool:
        return self.now.text == text and self.now.kind != "end"

    def take(self, text: str = "") -> Word:
        word = self.now
        if text and word.text != text:
            raise BadInput(f"line {word.line} of the shader: {word.text!r} where the runtime kit expects {text!r}")
        self.at += 1
        return word

    def maybe(self, text: str) -> bool:
        if self.ahead(text):
            self.at += 1
            return True
        return False

    def is_type(self, at: int) -> bool:
        word = self.words[at]
        return word.kind == "name" and (word.text in BUILT_IN or word.text in self.scope.structs)

    # the top

    def unit(self) -> Unit:
        items: list = []
        while self.now.kind != "end":
            doc = self.now.doc
            if self.ahead("struct"):
                items.append(self.struct(doc))
            elif self.is_type(self.at) and self.words[self.at + 2].text == "(":
                items.append(self.function(doc))
            else:
                items += self.variables(doc)
        return Unit(items)

    def struct(self, doc: list[str]) -> Struct:
        self.take("struct")
        name, members = self.take().text, []
        self.take("{")
        while not self.maybe("}"):
            members += self.variables(self.now.doc, member=True)
        self.take(";")
        made = Struct(name, members, doc)
        self.scope.structs[name] = made
        return made

    def function(self, doc: list[str]) -> Function:
        kind, name, parameters = self.take().text, self.take().text, []
        self.take("(")
        self.scope.push()
        while not self.maybe(")"):
            way = self.take().text if self.now.text in ("in", "out", "inout") else ""
            parameter = Variable(self.take().text, self.take().text, way=way)
            self.scope.declare(parameter)
            parameters.append(parameter)
            self.maybe(",")
        made = Function(name, kind, parameters, [], doc)
        self.scope.functions.setdefault(name, []).append(made)
        made.body = self.block()
        self.scope.pop()
        return made

    def variables(self, doc: list[str], member: bool = False) -> list[Variable]:
        way = self.take().text if self.now.text in ("uniform", "const") else ""
        kind, made = self.take().text, []
        while True:
            name = self.take().text
            size = self.size()
            value = self.expression(0) if self.maybe("=") else None
            one = Variable(kind + ("[]" if size else ""), name, size, value, way, doc if not made else [])
            made.append(one)
            if not member:
                self.scope.declare(one)
            if not self.maybe(","):
                break
        self.take(";")
        return made

    def size(self) -> Expr | None:
        if not self.maybe("["):
            return None
        size = self.expression()
        self.take("]")
        return size

    # statements

    def block(self) -> list[Statement]:
        self.take("{")
        self.scope.push()
        body = []
        while not self.maybe("}"):
            body.append(self.statement())
        self.scope.pop()
        return body

    def part(self) -> list[Statement]:
        return self.block() if self.ahead("{") else [self.statement()]

    def statement(self) -> Statement:
        if self.ahead("{"):
            return Statement("block", body=self.block())
        if self.maybe("if"):
            self.take("(")
            asked = self.expression()
            self.take(")")
            return Statement("if", [asked], self.part(), self.part() if self.maybe("else") else [])
        if self.maybe("for"):
            return self.loop()
        if self.maybe("return"):
            value = None if self.ahead(";") else self.expression()
            self.take(";")
            return Statement("return", [value])
        return self.simple()

    def simple(self) -> Statement:
        if self.ahead("const") or (self.is_type(self.at) and self.words[self.at + 1].kind == "name"):
            return Statement("declare", variables=self.variables([]))
        value = self.expression()
        self.take(";")
        return Statement("do", [value])

    def loop(self) -> Statement:
        self.take("(")
        self.scope.push()
        first = [] if self.maybe(";") else [self.simple()]
        asked = None if self.ahead(";") else self.expression()
        self.take(";")
        step = None if self.ahead(")") else self.expression()
        self.take(")")
        made = Statement("for", [asked, step], self.part(), first)
        self.scope.pop()
        return made

    # expressions

    def expression(self, level: int = 0) -> Expr:
        left = self.choose()
        if self.now.text in ASSIGN:
            word = self.take().text
            return Expr("assign", left.type, word, [left, self.expression()])
        return left

    def choose(self) -> Expr:
        asked = self.binary(0)
        if not self.maybe("?"):
            return asked
        one = self.expression()
        self.take(":")
        return Expr("choose", one.type, "", [asked, one, self.choose()])

    def binary(self, level: int) -> Expr:
        if level == len(LEVELS):
            return self.unary()
        left = self.binary(level + 1)
        while self.now.text in LEVELS[level] and self.now.kind == "sign":
            word = self.take().text
            right = self.binary(level + 1)
            left = Expr("binary", binary_type(word, left.type, right.type), word, [left, right])
        return left

    def unary(self) -> Expr:
        if self.now.text in ("-", "!", "++", "--", "+", "~"):
            word, of = self.take().text, self.unary()
            return Expr("unary", of.type, word, [of])
        return self.after(self.primary())

    def primary(self) -> Expr:
        word = self.take()
        if word.text == "(":
            inside = self.expression()
            self.take(")")
            return inside
        if word.kind == "num":
            real = any(c in word.text for c in ".eE")
            return Expr("num", "float" if real else "uint" if word.text.endswith("u") else "int", word.text)
        if word.text in ("true", "false"):
            return Expr("num", "bool", word.text)
        if self.ahead("("):
            return self.call(word)
        return Expr("name", self.scope.type_of(word), word.text)

    def call(self, word: Word) -> Expr:
        parts = []
        self.take("(")
        while not self.maybe(")"):
            parts.append(self.expression())
            self.maybe(",")
        if word.text in BUILT_IN or word.text in self.scope.structs:
            return Expr("new", word.text, word.text, parts)
        own = self.scope.function(word.text, [part.type for part in parts])
        if own:
            return Expr("call", own.type, own.key, parts)
        return Expr("call", call_type(word, [part.type for part in parts]), word.text, parts)

    def after(self, of: Expr) -> Expr:
        while True:
            if self.maybe("["):
                inside = self.expression()
                self.take("]")
                kind = of.type[:-2] if of.type.endswith("[]") else base(of.type)
                of = Expr("index", kind, "", [of, inside])
            elif self.maybe("."):
                name = self.take()
                of = Expr("field", field_type(self.scope, of.type, name), name.text, [of])
            elif self.now.text in ("++", "--"):
                of = Expr("post", of.type, self.take().text, [of])
            else:
                return of


def swizzle(of: Expr) -> bool:
    """True for `v.yz`, several parts of a vector."""
    return of.kind == "field" and width(of.parts[0].type) > 1 and len(of.text) > 1
