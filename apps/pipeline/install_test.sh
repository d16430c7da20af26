#!/usr/bin/env bash
# What is installed works without the checkout: tools, pictures, a page, completion, manual pages, and the library by
# find_package and by pkg-config.
. "$SOURCE/apps/testing.sh"
build=$(dirname "$(dirname "$(command -v sdm-lobes)")")
prefix=$scratch/prefix
cmake --install "$build" --prefix "$prefix" >install.log 2>&1
check "installed: $(tail -n 1 install.log)" test -x "$prefix/bin/sdm-lobes"
installed() { env -i HOME="$HOME" PATH="$prefix/bin:/usr/bin:/bin" "$@"; }
share=$prefix/share/stablecut

installed sdm-lobes "$share/testdata/thesis-table-6-2.json" --cut "$share/testdata/thesis-cut.json" --speed 8000:20000:9 --depth 0:3:9 -o lobes.json
installed plot-lobes lobes.json -o lobes.svg
check "a picture" grep -q "spindle speed" lobes.svg
if [ -e /usr/share/javascript/chart.js ]; then
  installed stablecut-report lobes.json -o page.html
  check "a page" grep -q "</html>" page.html
fi
if command -v make >/dev/null; then
  check "the studies find their tools and data" installed make -C "$share/scripts/studies" OUT="$PWD/studies" -n report >/dev/null
fi
check "every command's page in the manual" test "$(cd "$prefix/share/man/man1" && echo *.1)" = "$(cd "$prefix/bin" && for name in *; do echo "$name.1"; done | xargs)"
check "of a script what its help says" grep -q '^Usage: plot\\-lobes ' "$prefix/share/man/man1/plot-lobes.1"
check "and of the whole" test -s "$prefix/share/man/man7/stablecut.7" -a -s "$prefix/share/man/man5/stablecut.5"
for tool in "$prefix"/bin/*; do
  [ -L "$tool" ] || { name=$(basename "$tool")
    check "$name: completion" cmp <(installed "$name" --print-completion bash) "$prefix/share/bash-completion/completions/$name"; }
done

cat >limit.cc <<'END'
#include <cstdio>
#include "dynamics/modal_model.h"
#include "milling/limits.h"
using namespace stablecut;
// The least depth of one mode that chatters: 922 Hz, damping ratio 0.011.
int main() {
  dynamics::ModalModel model;
  model.dofs = {"x"};
  dynamics::Mode mode{922, 0.011, Eigen::VectorXcd::Ones(1), Eigen::VectorXcd::Constant(1, std::complex<double>(0, -0.00216))};
  model.modes.push_back(mode);
  milling::Cutter cutter;
  cutter.teeth = 2;
  cutter.kt_n_per_m2 = 689e6;
  cutter.kr_n_per_m2 = 267e6;
  cutter.exit_rad = 1;
  const auto depth = milling::limit_depth(milling::tip_structure(model), cutter, 9000 / 60.0, milling::StabilityMethod::kSpectral, 30, 0.03);
  std::printf("%.6f\n", depth.value_or(-1) * 1e3);
  return depth ? 0 : 1;
}
END
cat >CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.25)
project(consumer LANGUAGES CXX)
find_package(stablecut 0.1 REQUIRED)
add_executable(limit limit.cc)
target_compile_features(limit PRIVATE cxx_std_20)
target_link_libraries(limit PRIVATE stablecut::stablecut_milling)
END
cmake -S . -B consumer -G Ninja -DCMAKE_PREFIX_PATH="$prefix" >consumer.log 2>&1 && cmake --build consumer >>consumer.log 2>&1
check "find_package: $(tail -n 3 consumer.log | tr '\n' ' ')" consumer/limit
if command -v pkg-config >/dev/null; then
  PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name stablecut.pc)")
  export PKG_CONFIG_PATH
  # shellcheck disable=SC2046
  c++ limit.cc $(pkg-config --cflags --libs stablecut) -o by-pkg-config 2>pkg.log
  check "pkg-config gives the same: $(head -n 1 pkg.log)" cmp <(consumer/limit) <(./by-pkg-config)
else
  echo "pkg-config: skipped, it is not installed"
fi
