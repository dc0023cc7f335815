#include "sim/common/report_errors.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>

#include "sim/common/error.h"
#include "sim/common/standard_streams.h"

namespace usuzumi::sim {

void report_errors(int& exit_code, const std::function<int()>& body) {
  auto report = [&](ExitCode code, const char* line) {
    std::fflush(stdout);
    print_error(line);
    exit_code = exit_status(code);
  };
  try {
    exit_code = body();
  } catch (const Error& e) {
    report(e.code(), e.what());
  } catch (const std::bad_alloc&) {
    report(ExitCode::kDevice,
           "this computer has too little memory for that; close other programs or use a smaller model");
  } catch (const std::exception& e) {
    // Printing a long report throws; a short one is found lost at the end.
    if (!flush_standard_output()) return report(ExitCode::kCannotWrite, kStandardOutputLost);
    report(ExitCode::kDevice,
           fmt::format("a mistake of ours: {}; please report it with the command line", e.what()).c_str());
  }
}

}  // namespace usuzumi::sim
