// UnnotedLine.h - writes a file of one chained line in the older form, without a note on the file's end.
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
