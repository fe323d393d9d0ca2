#!/bin/sh
# compile.sh FOLDER OPTIONS: cmake --build, without the lines that report that
# there was nothing to do.
{
  status=$({ { cmake --build "$@" 3>&- 4>&-; echo $? >&3; } |
    grep --line-buffered -v -e 'Re-checking globbed directories' \
      -e '^ninja: no work to do' >&4; } 3>&1)
} 4>&1
exit "$status"
