#!/usr/bin/env bash
# No library of the device asks for a heap, throws or carries type information: reads the undefined and defined symbols of
# the static libraries given.
set -euo pipefail
status=0
for library in "$@"; do
  [ -s "$library" ] || { echo "$library: missing" >&2; exit 1; }
  found=$(nm --demangle=none "$library" 2>/dev/null | awk '{print $NF}' |
    grep -E '^(_Zn[wa]|_Zd[la]|malloc$|calloc$|realloc$|free$|aligned_alloc$|posix_memalign$|__cxa_(throw|allocate_exception|begin_catch)|_ZTI|_ZTS)' |
    grep -vE '^_ZTIN?[0-9]*$' | sort -u || true)
  if [ -n "$found" ]; then
    echo "$library: heap, exceptions or type information:"
    echo "$found" | c++filt | sed 's/^/  /'
    status=1
  fi
done
[ $status -eq 0 ] && echo "no heap, exception or type-information symbol in $# libraries"
exit $status
