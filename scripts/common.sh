# shellcheck shell=bash
# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
# Sourced by the scripts beside it: strict mode, the project's root as working directory.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Prints the names listed in scripts/packages.txt.
listed_packages()
{
  sed -e 's/#.*//' -e '/^[[:space:]]*$/d' scripts/packages.txt
}

# Prints our own source files that match the given git path patterns; files not yet added included.
own_files()
{
  git ls-files --cached --others --exclude-standard -- "$@" | sort -u | while read -r file; do
    if [ -f "$file" ]; then echo "$file"; fi
  done
}
