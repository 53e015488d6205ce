#include "tests/drivers/sensor_board/Golden.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/support/Support.h"

namespace tacto::test {

namespace {

std::vector<GoldenFrame> readGolden() {
    std::ifstream file(sourceDir() / "resources/firmware/sensor_board/PROTOCOL.md");
    std::vector<GoldenFrame> found;
    bool section = false, list = false;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("## ")) section = line.find("Golden frames") != std::string::npos;
        if (!section) continue;
        if (line.starts_with("```")) {
            list = !list;
        } else if (list && line.starts_with(" ")) {
            std::istringstream words(line);
            for (std::string word; words >> word;) {
                found.back().bytes.push_back(static_cast<std::uint8_t>(std::stoul(word, nullptr, 16)));
            }
        } else if (list) {
            found.push_back({line, {}});
        }
    }
    return found;
}

}  // namespace

const std::vector<GoldenFrame>& goldenFrames() {
    static const auto frames = readGolden();
    return frames;
}

const std::vector<std::uint8_t>& golden(std::string_view text) {
    for (const auto& frame : goldenFrames()) {
        if (frame.text.starts_with(text)) return frame.bytes;
    }
    throw std::invalid_argument("PROTOCOL.md has no golden frame " + std::string(text));
}

}  // namespace tacto::test
