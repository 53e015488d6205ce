#include <gtest/gtest.h>
#include <vector>

#include "core/calibration/ChainedLines.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

TEST(ChainedLines, WhatALineBringsByTheNamesOfTheChainIsTheChains) {
    RecordProperty("hazard", "H10");
    const ScratchDir folder;
    const auto path = folder.path() / "lines.jsonl";
    for (const int number : {1, 2}) {
        ChainedLines file(path, "line");
        const auto added = file.append([&]() -> Result<nlohmann::json> {
            const auto read = file.read([](const nlohmann::json&) { return Result<void>(); });
            if (!read) return failure(read);
            return nlohmann::json{{"number", number}, {"sha256", "claimed"}, {"previous", "claimed"}};
        });
        ASSERT_TRUE(added) << added.error().message;
    }
    std::vector<int> numbers;
    const auto read = ChainedLines(path, "line").read([&](const nlohmann::json& line) {
        numbers.push_back(line.at("number"));
        return Result<void>();
    });
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(numbers, (std::vector{1, 2}));
}

}  // namespace
}  // namespace tacto::test
