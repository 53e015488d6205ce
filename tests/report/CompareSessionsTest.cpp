// Two sessions compared: settings first, then quantities with the uncertainty of their difference, the most significant
// first.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "app/report/CompareSessions.h"
#include "app/report/ResultCells.h"
#include "core/kinds/ResultKinds.h"

namespace tacto::test {
namespace {

using nlohmann::json;

ComparedSession session(json results = json::object()) {
    ComparedSession made;
    made.about.protocol = "separability";
    made.about.parameters = {{"repeats", 25}};
    made.about.devices = {{"sim:stimulator", "stimulator", "simulated stimulator", "SIM-1", "1", true}};
    made.about.profileJson = R"({"encoding": {"A_max_v": 40}})";
    made.closed = true;
    made.verdicts = {{1, Instant(1), "separability", "pass", {}, std::move(results)}};
    return made;
}

const ComparedQuantity* quantityIn(const SessionComparison& compared, const std::string& name) {
    const auto found = std::ranges::find(compared.quantities, name, &ComparedQuantity::name);
    return found == compared.quantities.end() ? nullptr : &*found;
}

const DifferentSetting* settingIn(const SessionComparison& compared, const std::string& name) {
    const auto found = std::ranges::find(compared.settings, name, &DifferentSetting::name);
    return found == compared.settings.end() ? nullptr : &*found;
}

/// Adds trials of an instrument with this bias, which states the standard uncertainty `u`.
void addTrials(ComparedSession& to, std::mt19937& random, int n, double truth, double scatter, double u) {
    std::normal_distribution<double> normal;
    const double bias = u * normal(random);
    for (int i = 0; i < n; ++i) {
        const double read = truth + bias + scatter * normal(random);
        to.trials.push_back({i, i, Instant(i), "rough-high", {{"amplitude_v", read}, {"amplitude_u_v", u}}});
    }
}

TEST(CompareSessions, WhatIsTheSameIsNotReported) {
    const auto one = session({{"accuracy", 0.98}});
    const auto compared = compareTwo(one, one);
    EXPECT_TRUE(compared.settings.empty());
    EXPECT_TRUE(compared.quantities.empty());
    EXPECT_EQ(toJson(compared)["summary"], "The two sessions do not differ.");
}

TEST(CompareSessions, SettingsThatDifferAreNamedWithBothValues) {
    const auto a = session();
    auto b = session();
    b.about.parameters = {{"repeats", 40}};
    b.settings["repeats"] = {{"name", "repeats"}, {"label", "Repeats per condition"}, {"unit", ""}};
    b.about.devices[0].uri = "sim:stimulator?gain=1.05";
    b.about.profileJson = R"({"encoding": {"A_max_v": 38, "added": true}})";
    b.verdicts[0].verdict = "fail";
    b.labels.sample = "S-015";
    const auto compared = compareTwo(a, b);
    const auto* repeats = settingIn(compared, "Repeats per condition");
    ASSERT_NE(repeats, nullptr);
    EXPECT_EQ(repeats->a, 25);
    EXPECT_EQ(repeats->b, 40);
    ASSERT_NE(settingIn(compared, "Stimulator"), nullptr);
    EXPECT_THAT(settingIn(compared, "Stimulator")->b.get<std::string>(), testing::HasSubstr("gain=1.05"));
    ASSERT_NE(settingIn(compared, "Verdict"), nullptr);
    EXPECT_EQ(settingIn(compared, "Verdict")->b, "fail");
    ASSERT_NE(settingIn(compared, "Sample"), nullptr);
    EXPECT_TRUE(settingIn(compared, "Sample")->a.is_null());
    const auto* profile = settingIn(compared, "Profile, encoding, a max");
    ASSERT_NE(profile, nullptr) << toJson(compared).dump(1);
    EXPECT_EQ(profile->a, "40\u202fV");
    EXPECT_EQ(profile->b, "38\u202fV");
    EXPECT_NE(settingIn(compared, "Profile, encoding, added"), nullptr) << "what only one has is a difference too";
}

TEST(CompareSessions, SettingsAreWordsHoweverTheyAreBuilt) {
    auto a = session(), b = session();
    a.about.parameters = {{"grid", {{"rows", 3}, {"steps_v", {5, 10}}}}, {"times_s", {1, 2}}, {"gone", true}};
    b.about.parameters = {{"grid", {{"rows", 4}, {"steps_v", {5, 20}}}}, {"times_s", {1, 3}}};
    for (int i = 0; i < 40; ++i) b.trials.push_back({i, i, Instant(i), fmt::format("{} ohm", i), {}});
    const auto compared = compareTwo(a, b);
    ASSERT_NE(settingIn(compared, "Grid, rows"), nullptr) << toJson(compared).dump(1);
    EXPECT_EQ(settingIn(compared, "Grid, rows")->b, 4);
    ASSERT_NE(settingIn(compared, "Grid, steps"), nullptr);
    EXPECT_EQ(settingIn(compared, "Grid, steps")->b, "5\u202fV, 20\u202fV");
    ASSERT_NE(settingIn(compared, "Times"), nullptr);
    ASSERT_NE(settingIn(compared, "Gone"), nullptr) << "what only one has";
    EXPECT_TRUE(settingIn(compared, "Gone")->b.is_null());
    const auto* alone = settingIn(compared, "Conditions that only one has");
    ASSERT_NE(alone, nullptr);
    EXPECT_THAT(alone->b.get<std::string>(), testing::EndsWith("and 34 more"));
    for (const auto& [name, first, second] : compared.settings)
        for (const auto& value : {first, second}) EXPECT_FALSE(value.is_structured()) << name;
}

TEST(CompareSessions, TheDifferenceOfEqualOutputsIsMoreThanUInOneOfTwenty) {
    RecordProperty("hazard", "H9");
    std::mt19937 random(4909);
    std::uniform_int_distribution<int> repeats(2, 12);
    std::uniform_real_distribution<double> spread(0.01, 0.5);
    int more = 0;
    constexpr int kDraws = 3000;
    for (int draw = 0; draw < kDraws; ++draw) {
        auto a = session(), b = session();
        const double scatter = spread(random), u = spread(random);
        addTrials(a, random, repeats(random), 20, scatter, u);
        addTrials(b, random, repeats(random), 20, scatter, u);
        const auto compared = compareTwo(a, b);
        const auto* amplitude = quantityIn(compared, "Rough-high: Amplitude");
        ASSERT_NE(amplitude, nullptr);
        ASSERT_TRUE(amplitude->more().has_value());
        more += *amplitude->more();
    }
    EXPECT_GT(more, kDraws * 0.03) << "U is not made larger than it is";
    EXPECT_LT(more, kDraws * 0.07);
}

TEST(CompareSessions, ADifferenceOfManyUncertaintiesIsFoundAndStandsFirst) {
    std::mt19937 random(4910);
    for (int draw = 0; draw < 50; ++draw) {
        auto a = session({{"accuracy", 0.98}}), b = session({{"accuracy", 0.97}});
        addTrials(a, random, 8, 20, 0.05, 0.02);
        addTrials(b, random, 8, 22, 0.05, 0.02);
        b.length = toInstant(100.0);
        const auto compared = compareTwo(a, b);
        ASSERT_FALSE(compared.quantities.empty());
        const auto& first = compared.quantities.front();
        EXPECT_EQ(first.name, "Rough-high: Amplitude");
        EXPECT_EQ(first.more(), true);
        EXPECT_NEAR(first.difference(), 2, 0.3);
        EXPECT_FALSE(compared.quantities.back().more().has_value()) << "those without U stand last";
    }
}

TEST(CompareSessions, WithoutAStatedUncertaintyUIsNotKnown) {
    RecordProperty("hazard", "H9");
    auto a = session(), b = session();
    for (int i = 0; i < 5; ++i) {
        a.trials.push_back({i, i, Instant(i), "rough-high", {{"amplitude_v", 20 + 0.01 * i}}});
        b.trials.push_back({i, i, Instant(i), "rough-high", {{"amplitude_v", 25 + 0.01 * i}}});
    }
    const auto compared = compareTwo(a, b);
    const auto* amplitude = quantityIn(compared, "Rough-high: Amplitude");
    ASSERT_NE(amplitude, nullptr);
    EXPECT_FALSE(amplitude->more().has_value()) << "scatter alone is not the whole uncertainty";
    EXPECT_TRUE(toJson(compared)["quantities"][0]["expanded_uncertainty"].is_null());
}

TEST(CompareSessions, ResultsCarryTheUncertaintyThatTheirTablesStateBeside) {
    const auto withGain = [](double gain, double expanded) {
        return json{{"kind", "stimulator-calibration"},
                    {"amplitude",
                     {{"quantity", "amplitude"},
                      {"unit", "V"},
                      {"verdict", "pass"},
                      {"gain", gain},
                      {"gain_expanded_uncertainty", expanded},
                      {"offset", 0.01},
                      {"offset_expanded_uncertainty", 0.02}}}};
    };
    const auto compared = compareTwo(session(withGain(1.00, 0.003)), session(withGain(1.01, 0.004)));
    const auto* gain = quantityIn(compared, "Amplitude: Gain");
    ASSERT_NE(gain, nullptr) << toJson(compared).dump(1);
    EXPECT_NEAR(gain->expanded, 0.005, 1e-12) << "the root of the sum of both squares";
    EXPECT_EQ(gain->more(), true);
    EXPECT_EQ(compared.quantities.front().name, "Amplitude: Gain");
    const auto* offset = quantityIn(compared, "Amplitude: Offset");
    ASSERT_NE(offset, nullptr) << "the same, but with U: that it is the same is a result";
    EXPECT_EQ(offset->more(), false);
}

TEST(CompareSessions, OfUnequalBoundsThoseThatFaceEachOtherCount) {
    const auto withShare = [](double value, double low, double high) {
        return session({{"kind", "separability"}, {"accuracy", {{"value", value}, {"low", low}, {"high", high}}}});
    };
    // Newcombe's interval of 0.9 less 0.5 ends at 0.4 - sqrt(0.2² + 0.1²).
    const auto compared = compareTwo(withShare(0.5, 0.35, 0.6), withShare(0.9, 0.7, 0.95));
    ASSERT_EQ(compared.quantities.size(), 1U) << toJson(compared).dump(1);
    const auto& accuracy = compared.quantities.front();
    EXPECT_EQ(accuracy.unit, "%");
    EXPECT_NEAR(accuracy.difference(), 40, 1e-9);
    EXPECT_NEAR(accuracy.expanded, 100 * std::hypot(0.2, 0.1), 1e-9);
    const auto back = compareTwo(withShare(0.9, 0.7, 0.95), withShare(0.5, 0.35, 0.6));
    EXPECT_NEAR(back.quantities.front().expanded, accuracy.expanded, 1e-9) << "whichever stands first";
}

/// Returns JSON of any shape, with the keys that results have.
json anyJson(std::mt19937& random, int depth) {
    const auto pick = [&](int most) { return std::uniform_int_distribution<int>(0, most)(random); };
    static const char* const kKeys[] = {
        "kind",   "conditions", "pairs",    "matrix",   "lines",     "cells", "loads", "amplitude", "value",
        "low",    "high",       "mean",     "sd",       "n",         "unit",  "name",  "verdict",   "load",
        "levels", "disclosed",  "accuracy", "quantity", "commanded", "loads", "is"};
    static const char* const kWords[] = {
        "separability", "load-safety", "stimulator-calibration", "drift", "", "V", "rough-high", "pass", "own kind",
        "\x1b[2J",      "1 kohm"};
    switch (pick(depth > 0 ? 7 : 4)) {
        case 0:
            return nullptr;
        case 1:
            return std::uniform_real_distribution<double>(-1e3, 1e3)(random);
        case 2:
            return pick(1) == 1;
        case 3:
        case 4:
            return kWords[pick(int(std::size(kWords)) - 1)];
        case 5: {
            auto list = json::array();
            for (int left = pick(4); left > 0; --left) list.push_back(anyJson(random, depth - 1));
            return list;
        }
        default: {
            auto object = json::object();
            for (int left = pick(7); left > 0; --left)
                object[kKeys[pick(int(std::size(kKeys)) - 1)]] = anyJson(random, depth - 1);
            return object;
        }
    }
}

TEST(CompareSessions, AnyResultsOfAScriptAreComparedOrLeftOut) {
    RecordProperty("hazard", "H10");
    std::mt19937 random(4912);
    static const char* const kKinds[] = {"separability", "load-safety", "stimulator-calibration", "drift",
                                         "transitions",  "variation",   "sensor-calibration",     "own"};
    for (int round = 0; round < 1500; ++round) {
        ComparedSession both[2];
        const auto* kind = kKinds[std::uniform_int_distribution<std::size_t>(0, std::size(kKinds) - 1)(random)];
        for (auto& one : both) {
            auto results = anyJson(random, 4);
            if (results.is_object()) results["kind"] = kind;
            one = session(std::move(results));
            one.about.parameters = {{"p", anyJson(random, 2)}};
            one.about.profileJson = anyJson(random, 3).dump();
            one.trials = {{1, 1, Instant(1), "rough-high", anyJson(random, 2)}};
        }
        const auto compared = compareTwo(both[0], both[1]);
        const auto written = toJson(compared);
        for (const auto& table : tablesOf(written))
            for (const auto& column : table.columns) static_cast<void>(columnText(column, rowsOf(table, written)));
        double before = std::numeric_limits<double>::infinity();
        bool known = true;
        for (const auto& quantity : compared.quantities) {
            EXPECT_TRUE(std::isfinite(quantity.a) && std::isfinite(quantity.b));
            EXPECT_TRUE(known || !quantity.more()) << "those with U first";
            known = quantity.more().has_value();
            if (!known || quantity.expanded == 0) continue;
            const double ratio = std::abs(quantity.difference()) / quantity.expanded;
            EXPECT_LE(ratio, before) << "the most significant first";
            before = ratio;
        }
    }
}

TEST(CompareSessions, EachRowHasOneUnitInAllItsCells) {
    RecordProperty("hazard", "H9");
    SessionComparison compared;
    compared.quantities = {{"Amplitude", "V", 40, 0.5, 0.02},     {"Interval", "s", 0.5, 0.0123, 0.004},
                           {"Imbalance", "V", 0.02, 0.021, kNaN}, {"Onset", "s", 2, 2.0000004, 1e-6},
                           {"Charge", "C", 2e-6, 1.9e-9, 3e-10},  {"R", "", 0.5, 0.6, 0.01}};
    const auto written = toJson(compared);
    const auto tables = tablesOf(written);
    const auto table = std::ranges::find_if(tables, [](const auto& each) { return each.title.starts_with("Quantit"); });
    ASSERT_NE(table, tables.end());
    const auto texts = columnTexts(table->columns, rowsOf(*table, written));
    const char* units[] = {"V", "s", "mV", "s", "µC", ""};
    for (qsizetype row = 0; row < std::ssize(units); ++row) {
        for (std::size_t column = 1; column <= 3; ++column) {
            const auto cell = QString(texts[column].cells[row]).replace(QChar(0x202f), ' ').toStdString();
            const std::string unit = units[row];
            EXPECT_TRUE(unit.empty()
                            ? cell.find_first_not_of("0123456789. ±−") == std::string::npos
                            : cell.ends_with(" " + unit) || cell.find(" " + unit + " (U unknown)") != cell.npos)
                << cell << " in " << unit;
        }
    }
    const auto difference = [&](qsizetype row) { return QString(texts[3].cells[row]).remove(QChar(0x202f)); };
    EXPECT_EQ(difference(0), QStringLiteral("−39.500 ± 0.020V"));
    EXPECT_EQ(difference(3), QStringLiteral("0.0000004 ± 0.0000010s"));
}

TEST(CompareSessions, TheTablesAreOneKindForWindowAndTerminal) {
    auto a = session({{"accuracy", 0.98}}), b = session({{"accuracy", 0.71}});
    b.about.seed = 8;
    const auto written = toJson(compareTwo(a, b));
    const auto tables = tablesOf(written);
    ASSERT_EQ(tables.size(), resultTraits("comparison").tables.size());
    for (const auto& table : tables) {
        for (const auto& column : table.columns) {
            const auto text = columnText(column, rowsOf(table, written));
            ASSERT_EQ(text.cells.size(), 1) << table.title << ", " << column.title;
            EXPECT_FALSE(text.cells.front().isEmpty());
        }
    }
}

}  // namespace
}  // namespace tacto::test
