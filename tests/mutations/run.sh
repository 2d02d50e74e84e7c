#!/usr/bin/env bash
# Puts naive code back, one hard case at a time, and requires that its test then fails.
#
# tests/mutations/CASE.patch, or CASE-word.patch for a second mutant of the same case:
#
#   # case: R06                       the case of docs/hard-cases.md
#   # test: test_sensors              the test program
#   # filter: "R06*"                  what it is asked to run
#   # naive: one line that says what the naive code does
#   # unit: tests/sensors/x_test.cpp  only for a header: the source that is compiled against it
#   then a unified diff (-p1) of ONE product file, a source or a header
#
# The patch is applied to a copy in build/mutations; the source tree is never touched. The copy is
# compiled and linked with the commands that Ninja has for build/release, which must be up to date.
# Called as ./dev mutate [CASE...].
set -euo pipefail

root="$(dirname -- "$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")")"
cd -- "$root"
patches=tests/mutations
scratch=build/mutations
most_seconds=120 # a test of naive code may never end
most_kB=8388608  # or ask for all memory

# The value of a "# key: value" line, without quotation marks.
header_of() {
  local line
  while IFS= read -r line; do
    case "$line" in
      "# $2: "*)
        line="${line#"# $2: "}"
        line="${line#\"}"
        printf '%s\n' "${line%\"}"
        return
        ;;
      '#'*) ;;
      *) return ;;
    esac
  done <"$1"
}

# Writes the verdict of this mutant and ends: "killed" or anything else, and why.
verdict() {
  printf '%s\n' "$1" "$2" >"$folder/verdict"
  exit 0
}

# As Ninja runs it for build/release, without dependency files.
commands_of() {
  ninja -C build/release -t commands "$1" 2>/dev/null
}

test_passes() {
  # Where the test crashes, the shell would tell it too.
  { (ulimit -c 0 -v "$most_kB" && exec timeout "$most_seconds" "$1" -w NoTests "$2") >"$3" 2>&1; } 2>/dev/null
}

# Compiles `unit` as Ninja does, from `source` into `object`.
compile() {
  local command
  command="$(commands_of "$test" | grep -F -- " -c $root/$unit" || true)"
  [[ -n $command ]] || verdict broken "no command of $test compiles $unit"
  command="$(sed -E 's/ -MD -MT [^ ]+ -MF [^ ]+//' <<<"$command")"
  # The copy of a header is found before the original.
  command="${command/ -I/ -I$root/$folder/include -I}"
  command="${command%% -o *} -o $root/$folder/mutant.o -c $root/$source"
  (cd build/release && eval "$command") >"$folder/log" 2>&1 || verdict broken "does not compile: $folder/log"
}

# In place of the unit's object where the program itself has it, else before the libraries, so that
# the library's member is not asked for.
link_test() {
  local command object
  command="$(commands_of "$test" | grep -F -- " -o bin/$test " || true)"
  [[ -n $command ]] || verdict broken "no command links $test"
  object="tests/CMakeFiles/$test.dir/${unit#tests/}.o"
  if [[ $command == *" $object "* ]]; then
    command="${command/ $object / $root/$folder/mutant.o }"
    command="${command/ -o bin\/$test / -o $root/$folder/test }"
  else
    command="${command/ -o bin\/$test / $root/$folder/mutant.o -o $root/$folder/test }"
  fi
  (cd build/release && eval "$command") >"$folder/log" 2>&1 && return
  if grep -q 'multiple definition' "$folder/log"; then
    verdict broken "the library's own object was linked too: $folder/log"
  fi
  verdict broken "does not link: $folder/log"
}

judge() {
  local status=0
  test_passes "$folder/test" "$filter" "$folder/log" || status=$?
  if ((status == 124)); then verdict killed "does not end within $most_seconds s"; fi
  if ((status == 0)); then verdict SURVIVED "the test passes with naive code"; fi
  local line
  line="$(grep -A 1 'fatal error condition' "$folder/log" | tail -n 1 || true)"
  if [[ -n $line ]]; then verdict killed "crashes: ${line#"${line%%[! ]*}"}"; fi
  line="$(grep -E '^assertions:.* failed' "$folder/log" | tail -n 1 || true)"
  if [[ -z $line ]] && ((status > 128)); then verdict killed "crashes, signal $((status - 128))"; fi
  [[ -n $line ]] || verdict broken "exit status $status without a failed assertion: $folder/log"
  verdict killed "$(sed -E 's/ +/ /g; s/^assertions: ([0-9]+) .*\| ([0-9]+) failed.*/\2 of \1 assertions fail/' <<<"$line")"
}

run_one() {
  local patch="$1" name
  name="$(basename -- "$patch" .patch)"
  folder="$scratch/$name"
  rm -rf -- "$folder"
  mkdir -p -- "$folder/include"
  test="$(header_of "$patch" test)"
  filter="$(header_of "$patch" filter)"
  unit="$(header_of "$patch" unit)"
  local -a files
  mapfile -t files < <(sed -n 's/^+++ b\///p' "$patch" | sed 's/[[:space:]].*//')
  ((${#files[@]} == 1)) || verdict broken "patches ${#files[@]} files instead of one"
  local file="${files[0]}"
  [[ -n $test && -n $filter && -n $(header_of "$patch" naive) && $name == "$(header_of "$patch" case)"* ]] ||
    verdict broken "its first lines lack case, test, filter or naive"
  [[ -f $file ]] || verdict broken "there is no $file"
  mkdir -p -- "$folder/include/$(dirname -- "$file")"
  cp -- "$file" "$folder/include/$file"
  patch --strip=1 --batch --forward --fuzz=0 --directory="$folder/include" <"$patch" >"$folder/log" 2>&1 ||
    verdict broken "does not apply: $folder/log"

  if [[ $file == *.cpp ]]; then
    unit="$file"
    source="$folder/include/$file"
  else
    [[ -n $unit ]] || verdict broken "a header needs a line '# unit:'"
    source="$unit"
  fi
  test_passes "build/release/bin/$test" "$filter" "$folder/log" ||
    verdict broken "$test \"$filter\" fails or runs nothing without the patch: $folder/log"
  compile
  link_test
  judge
}

if [[ ${1:-} == --one ]]; then
  run_one "$2" # which ends the program
fi

shopt -s nullglob
chosen=()
if (($#)); then
  for name in "$@"; do
    found=("$patches/$name"*.patch)
    ((${#found[@]})) || {
      printf 'mutate: no mutant of %s in %s\n' "$name" "$patches" >&2
      exit 2
    }
    chosen+=("${found[@]}")
  done
else
  chosen=("$patches"/*.patch)
fi

printf '%s\0' "${chosen[@]}" | xargs -0 -n 1 -P "$(nproc)" bash "$patches/run.sh" --one || true

alive=0
printf '%-14s %-16s %-9s %s\n' mutant test verdict 'what happened; what the naive code does'
for patch in "${chosen[@]}"; do
  name="$(basename -- "$patch" .patch)"
  result=(broken 'was not run')
  if [[ -f $scratch/$name/verdict ]]; then mapfile -t result <"$scratch/$name/verdict"; fi
  printf '%-14s %-16s %-9s %s\n' "$name" "$(header_of "$patch" test)" "${result[0]}" \
    "${result[1]}; $(header_of "$patch" naive)"
  if [[ ${result[0]} != killed ]]; then alive=$((alive + 1)); fi
done
printf '%d mutants, %d killed by their tests\n' "${#chosen[@]}" "$((${#chosen[@]} - alive))"
((alive == 0))
