# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""Help, man page and completion of a program in Python, from its parser: as those of the programs in C++."""
from __future__ import annotations

import argparse
import sys
from typing import NoReturn, Optional

from . import __version__


class _Formatter(argparse.HelpFormatter):
    def _format_action_invocation(self, action: argparse.Action) -> str:
        return _names(action) + _value(action)


class Parser(argparse.ArgumentParser):
    """Tells in one line what is wrong, and prints what the build makes man page and completion from."""

    def __init__(self, prog: str, description: str) -> None:
        super().__init__(prog=prog, description=description, formatter_class=_Formatter)
        self.add_argument("--version", action="version", version=f"{prog} {__version__}")

    def error(self, message: str) -> NoReturn:
        raise ValueError(message)

    def printed(self, words: Optional[list[str]] = None) -> Optional[str]:
        """Returns what is asked for by the only word, or None."""
        asked = sys.argv[1:] if words is None else words
        if asked == ["--print-man-page"]:
            return _man_page(self)
        return _completion(self) if asked == ["--print-completion"] else None


def _names(action: argparse.Action) -> str:
    return ",".join(action.option_strings) or str(action.metavar or action.dest)


def _value(action: argparse.Action) -> str:
    if not action.option_strings or action.nargs == 0:
        return ""
    return f" {action.metavar or action.dest.upper()}"


def _roff(text: str) -> str:
    return text.replace("\\", "\\e").replace("-", "\\-")


def _actions(parser: argparse.ArgumentParser) -> list[argparse.Action]:
    return parser._actions  # argparse tells of them nowhere else


def _man_page(parser: argparse.ArgumentParser) -> str:
    name, description = parser.prog, parser.description or ""
    positionals = " ".join(_names(action) for action in _actions(parser) if not action.option_strings)
    page = [f'.TH "{_roff(name.upper())}" 1 "" "sigloc {__version__}" "User Commands"',
            f".SH NAME\n{_roff(name)} \\- {_roff(description[:1].lower() + description[1:].rstrip('.'))}",
            f".SH SYNOPSIS\n{_roff(name)} [OPTIONS] {_roff(positionals)}",
            f".SH DESCRIPTION\n{_roff(description)}\n.SH OPTIONS"]  # fmt: skip
    for action in _actions(parser):
        page.append(f".TP\n\\fB{_roff(_names(action))}\\fR{_roff(_value(action))}\n{_roff(action.help or '')}")
    return "\n".join(page) + "\n"


def _completion(parser: argparse.ArgumentParser) -> str:
    function = "_" + parser.prog.replace("-", "_")
    options = " ".join(name for action in _actions(parser) for name in action.option_strings)
    return f"""# bash completion for {parser.prog}
{function}()
{{
  COMPREPLY=()
  if [[ ${{COMP_WORDS[COMP_CWORD]}} == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "{options}" -- "${{COMP_WORDS[COMP_CWORD]}}")
  fi
}}
complete -o default -F {function} {parser.prog}
"""
