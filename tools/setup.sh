#!/bin/sh
# Installs the packages that Lightwalk needs and this machine lacks, with apt-get,
# Homebrew or MSYS2's pacman: tools/setup/packages.txt is the list. Asks no
# questions, and takes milliseconds if nothing is missing.
#
#   tools/setup.sh             what `make` and `make test` need
#   tools/setup.sh PURPOSE...  what another target needs in addition
#   tools/setup.sh all         all of it
#
# SETUP=print prints the commands, and exits with 1 if there are any.
# SETUP=no assumes that everything is installed.
set -euf
table=$(dirname "$0")/setup/packages.txt
newline='
'

say() {
  echo "setup: $*" >&2
}

# one_of WORD WORDS: whether it is one of them.
one_of() {
  case " $2 " in *" $1 "*) return 0 ;; esac
  return 1
}

# Check the arguments first.
purposes=
while IFS='|' read -r purpose rest; do
  purpose=${purpose% }
  case $purpose in '#'* | '') continue ;; esac
  one_of "$purpose" "$purposes" || purposes="$purposes$purpose "
done < "$table"
wanted=${*:-build}
for purpose in $wanted; do
  one_of "$purpose" "$purposes all" || {
    say "'$purpose' is not known; known are: ${purposes}all"
    exit 2
  }
done
case ${SETUP:=install} in
  install | print) ;;
  no) exit 0 ;;
  *) say "SETUP='$SETUP': print or no is expected"; exit 2 ;;
esac

has_program() {
  if [ "$1" = c++ ] && [ -n "${CXX:-}" ]; then return 0; fi
  command -v "$1" > /dev/null
}

has_modules() {
  python3 - "$@" 2> /dev/null <<'TEXT'
import importlib.util, sys
sys.exit(not all(importlib.util.find_spec(name) for name in sys.argv[1:]))
TEXT
}

has_header() {
  echo "#include <$1>" |
    ${CXX:-c++} -std=c++20 -E -x c++ - > /dev/null 2>&1
}

# Checks that a package's or a program's name is not enough for.
has_browser() {
  for name in Chromium "Google Chrome"; do
    if [ -d "/Applications/$name.app" ]; then return 0; fi
  done
  has_program chromium || has_program google-chrome ||
    has_program chromium-browser
}

has_libfuzzer() {
  for clang in "${FUZZ_CXX:-clang++}" /opt/homebrew/opt/llvm/bin/clang++ \
    /usr/local/opt/llvm/bin/clang++; do
    if echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, long) { return 0; }' |
      "$clang" -fsanitize=fuzzer,address -x c++ - -o /dev/null 2> /dev/null
    then return 0; fi
    if [ -n "${FUZZ_CXX:-}" ]; then break; fi
  done
  return 1
}

# Some systems have a folder for the header.
has_stb() {
  has_header stb_image.h || has_header stb/stb_image.h
}

has_webassembly() {
  printf '#include <vector>\nint main() { return std::vector<int>(1)[0]; }\n' |
    "${WASM_CXX:-clang++}" --target=wasm32-wasi -fno-exceptions -x c++ - \
      -o /dev/null 2> /dev/null
}

# is_there USE: whether the machine has it, from any source. A module is better
# evidence than a program, and a check is better than both.
is_there() {
  modules=
  others=
  for use in $1; do
    case $use in
      check:*) "has_${use#check:}"; return ;;
      module:*) modules="$modules ${use#module:}" ;;
      *) others="$others $use" ;;
    esac
  done
  # shellcheck disable=SC2086
  if [ -n "$modules" ]; then has_modules $modules; return; fi
  for use in $others; do
    case $use in
      program:*) if has_program "${use#*:}"; then return 0; fi ;;
      # A package manager knows better whether all of a library is there.
      file:*) [ -n "$manager" ] || [ ! -e "${use#*:}" ] || return 0 ;;
      header:*) [ -n "$manager" ] || ! has_header "${use#*:}" || return 0 ;;
    esac
  done
  return 1
}

if one_of fuzz "$wanted" && [ -n "${FUZZ_CXX:-}" ] && ! has_libfuzzer; then
  say "FUZZ_CXX='$FUZZ_CXX': Clang with libFuzzer and the sanitizers is expected"
  exit 1
fi

# The package manager, and the list of installed packages, one per line.
manager=
installed=
if has_program dpkg-query && has_program apt-get; then
  manager=apt-get
  installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' |
    sed -n 's/^installed //p')
elif [ -n "${MINGW_PACKAGE_PREFIX:-}" ] && has_program pacman; then
  manager=pacman
  installed=$(pacman -Qq)
elif has_program brew; then
  manager=brew
  installed=$(ls "$(brew --prefix)/opt" 2> /dev/null || true)
fi

# is_installed A/B/...: whether one of these packages is.
is_installed() {
  IFS=/
  # shellcheck disable=SC2086
  set -- $1
  unset IFS
  for package; do
    case $newline$installed$newline in
      *"$newline$package$newline"*) return 0 ;;
    esac
  done
  return 1
}

# What is missing: packages, and in words the things without a package here.
missing=
needed_words=
optional_words=
while IFS='|' read -r purpose use debian brew msys2 _ words optional; do
  purpose=${purpose% }
  case $purpose in '#'* | '') continue ;; esac
  one_of "$purpose" "$wanted" || one_of all "$wanted" || continue
  case $manager in
    apt-get) names=$debian ;;
    pacman) names=$msys2 ;;
    brew) names=$brew ;;
    *) names=- ;;
  esac
  absent=
  for name in $names; do
    if [ "$manager" = pacman ]; then
      case $name in
        -) ;;
        =*) name=${name#=} ;;
        *) name=$MINGW_PACKAGE_PREFIX-$name ;;
      esac
    fi
    is_installed "$name" || absent="$absent $name"
  done
  if [ -z "$absent" ] || is_there "$use"; then continue; fi
  words=${words# }
  words=${words% }
  if [ "$absent" != ' -' ]; then
    for name in $absent; do
      one_of "$name" "$missing" || missing="$missing $name"
    done
  elif [ -n "${optional# }" ]; then
    optional_words="${optional_words:+$optional_words, }$words"
  else
    needed_words="${needed_words:+$needed_words, }$words"
  fi
done < "$table"

# run COMMAND: prints it, and runs it unless SETUP=print.
run() {
  say "$*"
  [ "$SETUP" = print ] || "$@"
}

# choose: sets `chosen` to the missing packages; of alternatives it takes the
# first that the archive has.
choose() {
  chosen=
  for name in $missing; do
    IFS=/
    # shellcheck disable=SC2086
    set -- $name
    unset IFS
    name=$1
    if [ $# -gt 1 ]; then
      for package; do
        if apt-cache show "$package" > /dev/null 2>&1; then
          name=$package
          break
        fi
      done
    fi
    chosen="$chosen $name"
  done
}

# may_be_root: whether sudo is there and lets this user run apt-get.
may_be_root() {
  has_program sudo && {
    sudo -n apt-get --version > /dev/null 2>&1 || sudo -v
  }
}

status=0
# Packages are words.
# shellcheck disable=SC2086
if [ -n "$missing" ]; then
  chosen=$missing
  case $manager in
    apt-get)
      as_root=
      [ "$(id -u)" = 0 ] || as_root=sudo
      choose
      get="apt-get install --no-install-recommends$chosen"
      if [ "$SETUP" = install ] && [ -n "$as_root" ] && ! may_be_root; then
        say "please ask an administrator to run: $get"
        exit 1
      fi
      run $as_root apt-get update -q || true
      choose
      run $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y \
        --no-install-recommends $chosen || status=$?
      ;;
    pacman) run pacman -S --needed --noconfirm $chosen || status=$? ;;
    brew) run brew install $chosen || status=$? ;;
  esac
  if [ "$status" != 0 ]; then
    say "$manager could not install (see its message above):$chosen"
    exit 1
  fi
fi
if [ -n "$needed_words" ]; then
  if [ -n "$manager" ]; then
    say "$manager has no package of it; please install: $needed_words"
  else
    say "neither apt-get nor Homebrew nor MSYS2 is here; please install, or ask" \
      "an administrator for: $needed_words" \
      "${optional_words:+(and, for more, $optional_words)};" \
      "SETUP=no assumes that they are installed"
  fi
  exit 1
fi
[ -z "$missing" ] || [ "$SETUP" = install ]
