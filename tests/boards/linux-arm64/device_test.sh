#!/usr/bin/env bash
# The program itself on the kernel at hand, which need not have a GPIO chip or a card: what it says and how it ends.
set -uo pipefail
device=$1 status=0
# expect CODE WORDS ARGUMENT...
expect() {
  local code=$1 words=$2 said got
  shift 2
  said=$(timeout 10 "$device" "$@" 2>&1 </dev/null)
  got=$?
  if [ $got -ne "$code" ] || ! grep -qF -- "$words" <<<"$said"; then
    echo "$*: exit code $got with '$said'; expected $code with '$words'"
    status=1
  fi
}
expect 0 "Exit codes: 0 done" --help
expect 2 "error: --rom FILE is missing"
expect 2 "error: --size 3: give" --rom a --size 3
expect 5 "error: GPIO chip no such chip: not there" --rom "$0" --gpio-chip "no such chip"
expect 5 "error: GPIO chip /dev/null: no GPIO chip" --rom "$0" --gpio-chip /dev/null
expect 5 "note: --rom /nowhere.rom: No such file" --rom /nowhere.rom --gpio-chip "no such chip"
pipe=$(mktemp -u) && mkfifo "$pipe"
expect 5 "note: --rom $pipe: Wrong medium type" --rom "$pipe" --gpio-chip "no such chip"
rm "$pipe"
exit $status
