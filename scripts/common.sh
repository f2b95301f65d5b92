# shellcheck shell=bash
# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
# Sourced by the scripts beside it: strict mode, the project's root as working directory.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Prints the purposes of scripts/packages.txt.
listed_purposes()
{
  sed -n 's/^\[\(.*\)\]$/\1/p' scripts/packages.txt
}

# listed_packages PURPOSE...: prints the names that scripts/packages.txt lists under them.
listed_packages()
{
  awk -v purposes="$*" '
    BEGIN { for (n = split(purposes, names, " "); n > 0; n--) wanted[names[n]] }
    { sub(/#.*/, "") }
    /^\[/ { listing = substr($1, 2, length($1) - 2) in wanted; next }
    listing && NF { print $1 }' scripts/packages.txt | sort -u
}

# Prints our own source files that match the given git path patterns; files not yet added included.
own_files()
{
  git ls-files --cached --others --exclude-standard -- "$@" | sort -u | while read -r file; do
    if [ -f "$file" ]; then echo "$file"; fi
  done
}

# What scripts/test_sanitized runs beside the tests with threads, and scripts/coverage --sanitized
# counts: the labels, and the names of tests that are too slow for it. Each of those takes a second or
# more in a Release build, and several times that under the sanitizers. CampusMaps took 45 % of the time
# of all tests of unit, bridge and fuzz; that maps of every kind are read is tested without it.
# shellcheck disable=SC2034  # for the scripts beside this one
{
  sanitized_kinds=(unit bridge laws fuzz)
  slow_tests='^CampusMaps|APlaceFoundLate|WorkGrowsWithTheScans|IsTheSameInOneGo|OnGatedDrives'
  slow_tests+='|WakesUpInTwenty|IsSeldomLocalized|ClutterInAWideHall|IsSeldomConfident'
  slow_tests+='|IsNotConfidentlyWrong|FewReturnsTellLittle|KeepsTheCovarianceExactlyHonest'
}
