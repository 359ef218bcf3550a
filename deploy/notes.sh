#!/bin/sh
# Prints what CHANGELOG.md has under a version: deploy/notes.sh 0.1.0. Fails where it has nothing.
set -eu
awk -v version="${1:?a version is expected}" '
    index($0, "## [") == 1 { inside = index($0, "## [" version "]") == 1; next }
    inside { text = text $0 "\n" }
    END {
        gsub(/^\n+|\n+$/, "", text)
        if (text == "") exit 1
        print text
    }
' "$(dirname "$0")/../CHANGELOG.md"
