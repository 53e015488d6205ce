// UnnotedLine.h - a file of one chained line, written as it was before the end of such files was noted.
//
// Thread-safety: the test's own thread.
#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/JsonText.h"
#include "core/session/Digest.h"

namespace tacto::test {

inline void writeUnnoted(const std::filesystem::path& file, nlohmann::json line) {
    line.erase("sha256");
    line.erase("end_noted");
    line["sha256"] = sha256Hex(dumpJson(line));
    std::ofstream(file) << dumpJson(line) << '\n';
    std::filesystem::remove(file.string() + ".end");
}

}  // namespace tacto::test
