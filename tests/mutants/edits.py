"""All small changes that can be made to a stage's header, from its syntax tree.

Clang reads the header, and every statement and expression of it gives the
changes that make sense for it: a statement is dropped, a sign is flipped, a
comparison turned round. `all_mutants` returns them; nothing here compiles or
runs anything.
"""

import dataclasses
import re

from clang.cindex import CursorKind as Kind
from clang.cindex import Index, TypeKind

from tools.tree import Failure


@dataclasses.dataclass
class Mutant:
    """One change: `edits` are (start, end, new text) in bytes of the header.

    A statement's edits replace whole statements, and the others expressions.
    An exchange has two edits, everything else has one.
    """

    edits: list
    what: str
    function: str
    statement: bool = False
    before: str = ""
    after: str = ""


def parse(header, arguments):
    """The syntax tree of a header. Throws if Clang cannot parse it."""
    # Plain lanes need no headers of intrinsics from the compiler.
    options = ["-x", "c++", "-DLIGHTWALK_PLAIN_LANES", "-Wno-pragma-once-outside-header", *arguments]
    unit = Index.create().parse(str(header), options)
    errors = [one for one in unit.diagnostics if one.severity >= 3]
    if errors:
        raise Failure(f"libclang does not understand {header.name}: {errors[0]}")
    return unit


def type_name(cursor):
    """The type of an expression or variable, without const and reference."""
    kind = cursor.type.get_canonical()
    if kind.kind in (TypeKind.LVALUEREFERENCE, TypeKind.RVALUEREFERENCE):
        kind = kind.get_pointee()
    name = re.sub(r"\bconst\b", "", kind.spelling).strip()
    vector = re.match(r"glm::vec<(\d), float", name)
    return f"Vec{vector[1]}" if vector else name


def is_number(name):
    return name in ("float", "int", "double")


def is_signed_value(name):
    return is_number(name) or name.startswith("Vec")


WRAPPERS = (Kind.UNEXPOSED_EXPR, Kind.CALL_EXPR)


def peel(cursor):
    """The expression without implicit conversions and copies."""
    while cursor.kind in WRAPPERS:
        inner = [one for one in cursor.get_children() if one.kind.is_expression()]
        if len(inner) != 1 or span(inner[0]) != span(cursor):
            if cursor.kind == Kind.CALL_EXPR and cursor.spelling == "operator bool":
                cursor = next(inner[0].get_children())
                continue
            return cursor
        cursor = inner[0]
    return cursor


def span(cursor):
    return cursor.extent.start.offset, cursor.extent.end.offset


def expressions(cursor):
    return [one for one in cursor.get_children() if one.kind.is_expression()]


OPPOSITE = {"+": "-", "-": "+", "*": "/", "/": "*", "%": "/", "&&": "||", "||": "&&"}
COMPARISONS = {
    "<": ("<=", ">", ">="),
    "<=": ("<", ">=", ">"),
    ">": (">=", "<", "<="),
    ">=": (">", "<=", "<"),
    "==": ("!=",),
    "!=": ("==",),
}
ASSIGNMENTS = {"+=": ("-=", "="), "-=": ("+=", "="), "*=": ("/=", "="), "/=": ("*=", "=")}
SYMMETRIC = ("dot", "min", "max")  # whose arguments may be exchanged
ENDS = (Kind.RETURN_STMT, Kind.CONTINUE_STMT, Kind.BREAK_STMT)


class Walk:
    """Goes through the functions of one header and collects mutants."""

    def __init__(self, header, source):
        self.header = str(header)
        self.source = source
        self.mutants = []
        self.functions = []  # where each begins
        self.function = ""
        self.scopes = [[]]  # (name, type) of the visible names, innermost last
        self.result = ""  # what the function returns
        self.by_reference = False  # whether it returns a reference
        self.last_return = ""
        self.loop_kind = ""  # of the loop around: "", "endless" or "ends"

    # Collecting mutants.

    def text(self, cursor):
        start, end = span(cursor)
        return self.source[start:end].decode()

    def add(self, cursor, replacement, what, statement=False):
        if replacement != self.text(cursor):
            edit = (*span(cursor), replacement)
            self.mutants.append(Mutant([edit], what, self.function, statement))

    def exchange(self, one, other, what):
        first, second = self.text(one), self.text(other)
        if first != second:
            edits = [(*span(one), second), (*span(other), first)]
            self.mutants.append(Mutant(edits, what, self.function))

    def factor(self, cursor):
        """The text, in parentheses if a sign or `/` beside it needs them."""
        text = self.text(cursor)
        cursor = peel(cursor)
        binary = cursor.kind in (Kind.BINARY_OPERATOR, Kind.CONDITIONAL_OPERATOR) or self.operator(cursor)
        return f"({text})" if binary else text

    def operator(self, cursor):
        """(symbol, operands) of a built-in or overloaded operator, or None."""
        if cursor.kind in (Kind.BINARY_OPERATOR, Kind.COMPOUND_ASSIGNMENT_OPERATOR, Kind.UNARY_OPERATOR):
            operands = expressions(cursor)
        elif cursor.kind == Kind.CALL_EXPR and re.match(r"operator\W", cursor.spelling):
            operands = list(cursor.get_arguments())
            if cursor.spelling in ("operator->", "operator[]", "operator()"):
                return None
        else:
            return None
        if len(operands) == 2:
            gap = self.source[span(operands[0])[1] : span(operands[1])[0]].decode()
        elif len(operands) == 1:
            gap = self.source[span(cursor)[0] : span(operands[0])[0]].decode()
        else:
            return None
        return gap.strip(), operands

    def same_type(self, name, other_than):
        """The two nearest variables of a type in scope, by declaration."""
        flat = [one for scope in self.scopes for one in scope if one[1] == name]
        names = [one[0] for one in flat]
        if other_than not in names:
            return names[-2:]
        place = names.index(other_than)
        return [names[i] for i in (place - 1, place + 1) if 0 <= i < len(names)]

    # Declarations.

    def declarations(self, cursor):
        for one in cursor.get_children():
            if not one.location.file or one.location.file.name != self.header:
                continue
            if one.kind in (Kind.NAMESPACE, Kind.STRUCT_DECL):
                self.declarations(one)
            elif one.kind == Kind.CLASS_DECL:
                fields = [(f.spelling, type_name(f)) for f in one.get_children() if f.kind == Kind.FIELD_DECL]
                self.scopes.append(fields)
                self.declarations(one)
                self.scopes.pop()
            elif one.kind in (Kind.FUNCTION_DECL, Kind.CXX_METHOD, Kind.CONSTRUCTOR):
                self.in_function(one)
            elif one.kind in (Kind.VAR_DECL, Kind.FIELD_DECL):
                self.function = one.spelling
                self.variable(one)

    def in_function(self, cursor):
        self.function = cursor.spelling
        if cursor.kind != Kind.CONSTRUCTOR:
            self.functions.append(span(cursor)[0])
        self.result = type_name_of(cursor.result_type)
        self.by_reference = cursor.result_type.kind == TypeKind.LVALUEREFERENCE
        self.scopes.append([(p.spelling, type_name(p)) for p in cursor.get_arguments()])
        body = None
        for one in cursor.get_children():
            if one.kind == Kind.COMPOUND_STMT:
                body = one
            elif cursor.kind == Kind.CONSTRUCTOR and one.kind.is_expression():
                self.value(one)
        if body is not None:
            returns = [self.text(one) for one in body.walk_preorder() if one.kind == Kind.RETURN_STMT]
            self.last_return = returns[-1] + ";" if returns else "return;"
            self.block(body, last=True)
        self.scopes.pop()

    def variable(self, cursor):
        inits = expressions(cursor)
        if inits:
            init = peel(inits[-1])
            start = self.text(init)
            if init.kind == Kind.CALL_EXPR and start.startswith((cursor.spelling + "(", "{")):
                self.expression(init)  # the only expression of `Vec3 sum(0);` is the 0
                return
            self.value(init, zero=init.kind != Kind.INIT_LIST_EXPR)

    # Statements.

    def block(self, cursor, last=False):
        self.scopes.append([])
        children = list(cursor.get_children())
        for place, one in enumerate(children):
            self.statement(one, last=last and place == len(children) - 1)
        self.scopes.pop()

    def whole(self, cursor):
        """The statement's text with its semicolon."""
        start, end = span(cursor)
        return self.source[start:end].decode() + ";"

    def add_statement(self, cursor, replacement, what):
        """Replaces a statement that ends with a semicolon."""
        start, end = span(cursor)
        semicolon = self.source.index(b";", end)
        edit = (start, semicolon + 1, replacement)
        self.mutants.append(Mutant([edit], what, self.function, True))

    def statement(self, cursor, last=False, droppable=True):
        kind = cursor.kind
        children = list(cursor.get_children())
        if kind == Kind.COMPOUND_STMT:
            self.block(cursor, last)
        elif kind == Kind.DECL_STMT:
            self.declared(children)
        elif kind == Kind.IF_STMT:
            self.condition(children[0])
            has_else = len(children) > 2
            if has_else:
                self.add(cursor, ";", "statement dropped", True)
            for one in children[1:]:
                self.statement(one, last=last and has_else, droppable=has_else or self.many(one))
        elif kind in (Kind.FOR_STMT, Kind.WHILE_STMT):
            self.loop(children)
        elif kind == Kind.CXX_FOR_RANGE_STMT:
            self.range_loop(cursor, children)
        elif kind == Kind.SWITCH_STMT:
            self.switch(children, last)
        elif kind in ENDS:
            self.end(cursor, children, last, droppable)
        elif kind.is_expression():
            self.expression_statement(cursor, droppable)

    @staticmethod
    def many(cursor):
        return cursor.kind == Kind.COMPOUND_STMT and len(list(cursor.get_children())) > 1

    def declared(self, children):
        for one in children:
            if one.kind == Kind.VAR_DECL:
                self.variable(one)
                self.scopes[-1].append((one.spelling, type_name(one)))
            else:  # structured bindings
                for inner in one.get_children():
                    if inner.kind.is_expression():
                        self.value(inner)
                    else:
                        self.scopes[-1].append((inner.spelling, type_name(inner)))

    def loop(self, children):
        self.scopes.append([])
        *head, body = children
        outer, self.loop_kind = self.loop_kind, "endless"
        for one in head:
            if one.kind == Kind.DECL_STMT:
                self.declared(one.get_children())
            elif type_name(one) == "bool":
                self.loop_kind = "ends"
                self.condition(one)
            else:
                self.expression(one)
        self.statement(body)
        self.loop_kind = outer
        self.scopes.pop()

    def range_loop(self, cursor, children):
        variable, *rest, body = children
        for one in rest:
            if one.kind.is_expression():
                self.expression(one)
        self.scopes.append([(variable.spelling, type_name(variable))])
        outer, self.loop_kind = self.loop_kind, "ends"
        self.statement(body)
        start, end = span(body)
        text = self.source[start:end].decode()
        first_only = text[:-1].rstrip() + "\nbreak;\n}"
        self.mutants.append(
            Mutant([(start, end, first_only)], "loop left after a round", self.function, True)
        )
        self.loop_kind = outer
        self.scopes.pop()

    def switch(self, children, last):
        self.expression(children[0])
        arms = [one for one in children[1].get_children()]
        for place, one in enumerate(arms):
            while one.kind in (Kind.CASE_STMT, Kind.DEFAULT_STMT):
                one = list(one.get_children())[-1]
            self.statement(one, last=last and place == len(arms) - 1)

    def end(self, cursor, children, last, droppable):
        """return, continue and break."""
        value = peel(children[0]) if children else None
        if droppable and not (last and self.result != "void"):
            self.add_statement(cursor, ";", "statement dropped")
        if self.loop_kind:
            for other in ("continue;", "break;", self.last_return):
                # No code follows an endless loop.
                if other != self.whole(cursor) and (other != "break;" or self.loop_kind == "ends"):
                    self.add_statement(cursor, other, "way of leaving exchanged")
        if value is None:
            return
        zero = zero_of(self.result)
        if zero and not self.by_reference and self.text(value) != zero:
            self.add_statement(cursor, f"return {zero};", "zero returned")
        if self.by_reference:
            self.expression(value)
        elif self.result == "bool":
            self.condition(value)
        else:
            self.value(value)

    def expression_statement(self, cursor, droppable):
        text = self.whole(cursor)
        inner = peel(cursor)
        if droppable:
            self.add_statement(cursor, ";", "statement dropped")
        operator = self.operator(inner)
        if operator and operator[0] != "=":
            self.add_statement(cursor, f"{text} {text}", "statement made twice")
        if not operator and self.draws(inner):
            self.add_statement(cursor, f"{text} {text}", "statement made twice")
        self.expression(inner, statement=True)

    # Expressions.

    def condition(self, cursor):
        self.add(cursor, "true", "condition always true")
        self.add(cursor, "false", "condition always false")
        inner = peel(cursor)
        operator = self.operator(inner)
        if not (operator and (operator[0] in COMPARISONS or operator[0] == "!")):
            self.add(cursor, f"!{self.factor(cursor)}", "condition negated")
        self.expression(inner)

    def value(self, cursor, zero=False, replace=True):
        """A place where a value is used: initializer, argument, returned value."""
        cursor = peel(cursor)
        name = type_name(cursor)
        text = self.text(cursor)
        literal = cursor.kind in (Kind.INTEGER_LITERAL, Kind.FLOATING_LITERAL)
        if is_signed_value(name) and not literal and cursor.kind != Kind.INIT_LIST_EXPR:
            operator = self.operator(cursor)
            if not (operator and operator[0] == "-" and len(operator[1]) == 1):
                if not re.fullmatch(r"Vec\d\(0\)|\w+\(0\)|\w+\{0\}", text):
                    self.add(cursor, f"-{self.factor(cursor)}", "sign flipped")
        if zero and zero_of(name) and name != "bool" and not literal:
            self.add(cursor, zero_of(name), "zero in its place")
        if name == "bool" and cursor.kind != Kind.CXX_BOOL_LITERAL_EXPR:
            self.condition(cursor)
        else:
            self.expression(cursor)

    def expression(self, cursor, statement=False):
        cursor = peel(cursor)
        kind = cursor.kind
        operator = self.operator(cursor)
        if operator:
            self.operators(cursor, *operator, statement)
        elif kind in (Kind.INTEGER_LITERAL, Kind.FLOATING_LITERAL):
            self.literal(cursor)
        elif kind == Kind.CXX_BOOL_LITERAL_EXPR:
            self.add(cursor, {"true": "false", "false": "true"}[self.text(cursor)], "literal changed")
        elif kind == Kind.CONDITIONAL_OPERATOR:
            condition, one, other = expressions(cursor)
            self.condition(condition)
            self.expression(one)
            self.expression(other)
        elif kind == Kind.DECL_REF_EXPR:
            self.name(cursor)
        elif kind == Kind.MEMBER_REF_EXPR:
            self.member(cursor)
        elif kind == Kind.ARRAY_SUBSCRIPT_EXPR or cursor.spelling == "operator[]":
            array, index = expressions(cursor) if kind != Kind.CALL_EXPR else cursor.get_arguments()
            self.index(index)
            self.expression(array)
        elif kind == Kind.INIT_LIST_EXPR:
            self.arguments(list(cursor.get_children()))
        elif kind == Kind.CALL_EXPR:
            self.call(cursor)
        elif kind == Kind.LAMBDA_EXPR:
            self.scopes.append([])
            for one in cursor.get_children():
                if one.kind == Kind.PARM_DECL:
                    self.scopes[-1].append((one.spelling, type_name(one)))
                if one.kind == Kind.COMPOUND_STMT:
                    outer, self.result = self.result, ""
                    self.block(one, last=True)
                    self.result = outer
            self.scopes.pop()
        else:
            for one in expressions(cursor):
                self.expression(one)

    def operators(self, cursor, symbol, operands, statement):
        name = type_name(cursor)
        if len(operands) == 1:
            (one,) = operands
            if symbol in ("-", "!"):
                self.add(cursor, self.text(one), "sign flipped" if symbol == "-" else "condition negated")
            if symbol == "++":
                self.add(cursor, f"--{self.text(one)}", "sign flipped")
                self.add(cursor, f"{self.text(one)} += 2", "literal changed")
                self.add(cursor, self.text(one), "operand dropped")
                return
            self.expression(one)
            return
        left, right = operands
        a, b = self.text(left), self.text(right)
        if symbol in ASSIGNMENTS:
            for other in ASSIGNMENTS[symbol]:
                self.add(cursor, f"{a} {other} {b}", "operator exchanged")
            self.value(right)
            return
        if symbol == "=":
            self.value(right)
            return
        if symbol in COMPARISONS:
            for other in COMPARISONS[symbol]:
                self.add(cursor, f"{a} {other} {b}", "comparison changed")
            for one in (left, right):
                if type_name(peel(one)) == "int" and peel(one).kind != Kind.INTEGER_LITERAL:
                    for step in ("+ 1", "- 1"):
                        self.add(one, f"{self.factor(one)} {step}", "bound moved")
                self.expression(one)
            return
        if symbol in OPPOSITE:
            other = OPPOSITE[symbol]
            second = self.factor(right) if other in "*/" else b
            first = self.factor(left) if other in "*/" and symbol not in "*/%" else a
            self.add(cursor, f"{first} {other} {second}", "operator exchanged")
            keeps = [one for one in operands if same_kind(type_name(peel(one)), name)]
            if symbol in "-/" and len(keeps) == 2:
                swapped = f"{b} {symbol} {self.factor(left)}"
                self.add(cursor, swapped, "operands exchanged")
            if left in keeps:
                self.add(cursor, a, "operand dropped")
            if right in keeps and symbol not in "-/%":
                self.add(cursor, b, "operand dropped")
            if right in keeps and symbol == "-":
                self.add(cursor, f"-{self.factor(right)}", "operand dropped")
            if symbol in ("&&", "||"):
                self.add(cursor, a, "operand dropped")
        self.expression(left)
        self.expression(right)

    def literal(self, cursor):
        text = self.text(cursor)
        if cursor.kind == Kind.INTEGER_LITERAL:
            number = int(text, 0)
            for other in {number + 1, number - 1, 0} - {number}:
                self.add(cursor, str(other), "literal changed")
            return
        number = float.fromhex(text.rstrip("fF")) if "x" in text else float(text.rstrip("fF"))
        for other in {2 * number, number / 2, 0.0, 1.0 if number == 0 else 0.0} - {number}:
            self.add(cursor, f"{other!r}f", "literal changed")

    def index(self, cursor):
        inner = peel(cursor)
        if inner.kind == Kind.INTEGER_LITERAL:
            number = int(self.text(inner), 0)
            for other in {number + 1, max(0, number - 1)} - {number}:
                self.add(inner, str(other), "index changed")
            return
        if is_number(type_name(inner)) or "int" in type_name(inner) or "long" in type_name(inner):
            for other in ("0", f"{self.factor(inner)} + 1", f"{self.factor(inner)} - 1"):
                self.add(inner, other, "index changed")
        self.expression(inner)

    def name(self, cursor):
        target = cursor.referenced
        if target is None:
            return
        text = self.text(cursor)
        if target.kind == Kind.ENUM_CONSTANT_DECL:
            if type_name(cursor).startswith("std::"):
                return
            prefix = text[: len(text) - len(target.spelling)]
            for one in target.semantic_parent.get_children():
                if one.spelling != target.spelling:
                    self.add(cursor, prefix + one.spelling, "name exchanged")
            return
        if target.kind not in (Kind.VAR_DECL, Kind.PARM_DECL, Kind.FIELD_DECL, Kind.UNEXPOSED_DECL):
            return
        name = type_name(cursor)
        if target.kind == Kind.VAR_DECL and target.semantic_parent.kind == Kind.NAMESPACE:
            if name == "float":
                self.add(cursor, f"(2 * {text})", "constant changed")
                self.add(cursor, f"({text} / 2)", "constant changed")
            elif name == "int":
                self.add(cursor, f"({text} + 1)", "constant changed")
                self.add(cursor, f"({text} - 1)", "constant changed")
            return
        for other in self.same_type(name, text):
            self.add(cursor, other, "name exchanged")

    def member(self, cursor):
        """a.b: b's neighbors in its record, and a.c.b or a.b for a.c.b."""
        bases = expressions(cursor)
        if not bases:  # a member of this
            self.name(cursor)
            return
        base = bases[0]
        base_text = self.text(base)
        symbol = "->" if "->" in self.text(cursor)[len(base_text) :] or "->" in base_text[-2:] else "."
        stem = self.text(cursor)[: -len(cursor.spelling)]
        target = cursor.referenced
        if target is not None and target.kind == Kind.FIELD_DECL:
            if re.fullmatch("[xyz]", cursor.spelling):
                letters = "xy" if type_name(peel(base)) == "Vec2" else "xyz"
                for one in letters:
                    self.add(cursor, stem + one, "member exchanged")
            else:
                fields = [one for one in target.semantic_parent.get_children() if one.kind == Kind.FIELD_DECL]
                alike = [one.spelling for one in fields if type_name(one) == type_name(target)]
                place = alike.index(cursor.spelling)
                for step in (-1, 1):
                    if 0 <= place + step < len(alike):
                        self.add(cursor, stem + alike[place + step], "member exchanged")
                for one in fields:
                    self.nested(cursor, stem, one)
            inner = peel(base)
            if inner.kind == Kind.MEMBER_REF_EXPR and symbol == ".":
                outer = expressions(inner)
                if outer and has_field(outer[0], cursor.spelling, type_name(target)):
                    up = self.text(inner)[: -len(inner.spelling)] + cursor.spelling
                    self.add(cursor, up, "member exchanged")
        self.expression(base)

    def nested(self, cursor, stem, field):
        record = field.type.get_canonical()
        if record.kind == TypeKind.LVALUEREFERENCE:
            record = record.get_pointee()
        for one in record.get_fields():
            if one.spelling == cursor.spelling and type_name(one) == type_name(cursor.referenced):
                self.add(cursor, f"{stem}{field.spelling}.{one.spelling}", "member exchanged")

    def draws(self, cursor):
        """Whether it takes numbers from a random number generator."""
        return any(
            one.kind == Kind.DECL_REF_EXPR and type_name(one) == "lightwalk::Random"
            for one in cursor.walk_preorder()
        )

    def call(self, cursor):
        arguments = [one for one in cursor.get_arguments() if one is not None and self.text(one)]
        name = type_name(cursor)
        text = self.text(cursor)
        direct = [one for one in cursor.get_arguments() if self.draws(one)] or [
            one for one in expressions(cursor)[:1] if one.kind == Kind.MEMBER_REF_EXPR and self.draws(one)
        ]
        if direct and name != "void":
            self.add(cursor, f"(static_cast<void>({text}), {text})", "call made twice")
        is_constructor = cursor.referenced is not None and cursor.referenced.kind == Kind.CONSTRUCTOR
        if not is_constructor:
            for one in arguments:
                if type_name(peel(one)) == name:
                    self.add(cursor, self.factor(one), "call replaced by its argument")
        called = expressions(cursor)
        if called and called[0].kind == Kind.MEMBER_REF_EXPR:
            for base in expressions(called[0]):
                self.expression(base)
        changed = set()
        if cursor.referenced is not None:
            for place, one in enumerate(cursor.referenced.get_arguments()):
                kind = one.type.get_canonical()
                if kind.kind == TypeKind.LVALUEREFERENCE and not kind.get_pointee().is_const_qualified():
                    changed.add(place)
        self.arguments(arguments, changed, cursor.spelling in SYMMETRIC)

    def arguments(self, given, changed=(), symmetric=False):
        """`changed` are those that the function may change."""
        inner = [peel(one) for one in given]
        for place, one in enumerate(inner):
            if place not in changed:
                self.value(one)
        for one, other in zip(inner, inner[1:]):
            if not symmetric and same_kind(type_name(one), type_name(other)):
                self.exchange(one, other, "arguments exchanged")


def has_field(cursor, name, kind):
    record = peel(cursor).type.get_canonical()
    return any(one.spelling == name and type_name(one) == kind for one in record.get_fields())


def same_kind(one, other):
    return one == other or (is_number(one) and is_number(other))


def type_name_of(kind):
    """type_name of a type."""

    class Typed:
        type = kind

    return type_name(Typed)


def zero_of(name):
    if is_number(name):
        return "0"
    if name.startswith("Vec"):
        return f"{name}(0)"
    return "std::nullopt" if name.startswith("std::optional") else ""


def lines_around(source, start, end):
    first = source.rfind(b"\n", 0, start) + 1
    last = source.find(b"\n", end)
    return first, last if last >= 0 else len(source)


def squeeze(text):
    """The text on one line, without comments."""
    text = re.sub(r"//.*", "", text)
    text = re.sub(r"\s+", " ", text).strip()
    return re.sub(r"([(\[]) | ([)\];,])", r"\1\2", text)


def all_mutants(header, arguments):
    """Every mutant of a stage's header, each changed text once; and the starts of its functions."""
    source = header.read_bytes()
    walk = Walk(header, source)
    walk.declarations(parse(header, arguments).cursor)
    seen, result = set(), []
    for one in walk.mutants:
        first, last = lines_around(source, min(e[0] for e in one.edits), max(e[1] for e in one.edits))
        text, shift = source[first:last], -first
        after = text
        for start, end, new in sorted(one.edits, reverse=True):
            after = after[: start + shift] + new.encode() + after[end + shift :]
        one.before, one.after = squeeze(text.decode()), squeeze(after.decode())
        whole = source[:first] + after + source[last:]
        key = squeeze(whole.decode())
        if one.before != one.after and key not in seen:
            seen.add(key)
            result.append(one)
    return result, walk.functions
