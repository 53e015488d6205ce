#include "tests/cli/Shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tacto::test {

const Words kConditions{"smooth-low", "smooth-high", "rough-low", "rough-high"};

Json jsonOf(const Ran& ran) {
    auto value = Json::parse(ran.out, nullptr, false);
    EXPECT_FALSE(value.is_discarded()) << "stdout is not one JSON value:\n" << ran.out << "\nstderr:\n" << ran.err;
    return value.is_discarded() ? Json() : value;
}

void expectRefused(const Ran& ran, int code, const Words& parts) {
    EXPECT_EQ(ran.code, code) << ran.err;
    EXPECT_EQ(ran.out, "");
    EXPECT_TRUE(ran.err.starts_with("tactoscope-cli: ")) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    for (const auto& part : parts) EXPECT_THAT(ran.err, testing::HasSubstr(part));
}

void expectKeys(const Json& value, const Words& keys, const std::string& what) {
    ASSERT_TRUE(value.is_object()) << what << " is " << value.dump();
    for (const auto& key : keys) EXPECT_TRUE(value.contains(key)) << what << " has no " << key;
}

void expectStatistic(const Json& value, const std::string& what) {
    expectKeys(value, {"mean", "sd", "median", "min", "max", "n"}, what);
    ASSERT_EQ(value.size(), 6U) << what;
    ASSERT_TRUE(value["n"].is_number_unsigned()) << what;
    if (value["n"] == 0) {
        for (const auto* key : {"mean", "sd", "median", "min", "max"}) EXPECT_TRUE(value[key].is_null()) << what;
        return;
    }
    EXPECT_EQ(value["n"].get<int>() > 1, value["sd"].is_number()) << what << value.dump();
    // Because of rounding, the mean of equal numbers may lie just outside their range.
    const double slack = 1e-12 * (1 + std::abs(value["max"].get<double>()));
    EXPECT_LE(value["min"].get<double>(), value["mean"].get<double>() + slack) << what;
    EXPECT_LE(value["mean"].get<double>(), value["max"].get<double>() + slack) << what;
    EXPECT_LE(value["min"].get<double>(), value["median"].get<double>()) << what;
    EXPECT_LE(value["median"].get<double>(), value["max"].get<double>()) << what;
}

void expectEstimate(const Json& value, const std::string& what) {
    expectKeys(value, {"value", "low", "high"}, what);
    ASSERT_EQ(value.size(), 3U) << what;
    EXPECT_LE(value["low"].get<double>(), value["value"].get<double>()) << what;
    EXPECT_LE(value["value"].get<double>(), value["high"].get<double>()) << what;
}

void expectSeparability(const Json& results) {
    expectKeys(results, {"conditions", "pairs", "confusion", "accuracy"}, "results");
    ASSERT_EQ(results["conditions"].size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        const auto& condition = results["conditions"][i];
        expectKeys(condition, {"name", "n", "amplitude_v", "interval_s"}, "a condition");
        EXPECT_EQ(condition["name"], kConditions[i]);
        expectStatistic(condition["amplitude_v"], kConditions[i] + " amplitude");
        expectStatistic(condition["interval_s"], kConditions[i] + " interval");
        EXPECT_EQ(condition["n"], condition["amplitude_v"]["n"]);
    }
    std::vector<std::pair<std::string, std::string>> pairs;
    for (const auto& pair : results["pairs"]) {
        expectKeys(pair, {"a", "b", "mahalanobis"}, "a pair");
        EXPECT_GE(pair["mahalanobis"].get<double>(), 0);
        pairs.emplace_back(pair["a"], pair["b"]);
    }
    std::vector<std::pair<std::string, std::string>> expected;
    for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = a + 1; b < 4; ++b) expected.emplace_back(kConditions[a], kConditions[b]);
    }
    EXPECT_EQ(pairs, expected);
    ASSERT_EQ(results["confusion"].size(), 4U);
    for (std::size_t row = 0; row < 4; ++row) {
        ASSERT_EQ(results["confusion"][row].size(), 4U);
        int sum = 0;
        for (const auto& cell : results["confusion"][row]) sum += cell.get<int>();
        EXPECT_EQ(sum, results["conditions"][row]["n"].get<int>()) << "row " << row;
    }
    expectEstimate(results["accuracy"], "accuracy");
}

}  // namespace tacto::test
