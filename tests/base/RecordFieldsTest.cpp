#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/RecordFields.h"
#include "core/base/Statistics.h"
#include "core/base/Units.h"

namespace tacto {
namespace {

using nlohmann::json;
using testing::HasSubstr;

enum class Colour { Red, Blue };
constexpr Word<Colour> kColours[] = {{"red", Colour::Red}, {"blue", Colour::Blue}};

struct Grip {
    Volts drive{5};
    Seconds time{1};
    std::optional<double> area;
    bool operator==(const Grip&) const = default;
};
struct Thing {
    std::string name = "nameless";
    Colour colour = Colour::Red;
    std::uint64_t seed = 0;
    int count = 1;
    Grip grip;
    std::vector<Grip> grips;
    bool operator==(const Thing&) const = default;
};

RecordFields<Grip> gripFields() {
    RecordFields<Grip> all;
    all.number("drive_v", &Grip::drive, {.low = 0, .high = 10, .openLow = true, .unit = "V"}).required = true;
    all.number("time_s", &Grip::time, {.low = 0, .unit = "s"});
    all.number("area_cm2", &Grip::area).leftOutIfEmpty = true;
    return all;
}

RecordFields<Thing> thingFields() {
    RecordFields<Thing> all;
    all.text("name", &Thing::name);
    all.word("colour", &Thing::colour, kColours);
    all.number("seed", &Thing::seed);
    all.number("count", &Thing::count, {.low = 1, .high = 9});
    all.number("held_s", in(&Thing::grip, &Grip::time));
    all.list("grips", &Thing::grips, gripFields().kind(), 0, 2);
    all.note("about");
    all.rule([](const Thing& thing) -> Result<void> {
        if (thing.count != 7) return {};
        return fail(ErrorCode::InvalidArgument, "7 is out of luck");
    });
    return all;
}

TEST(RecordFields, NullIsNoValueWhereAMissingKeyIsHowNoneIsWritten) {
    EXPECT_TRUE(gripFields().read(json{{"drive_v", 1}, {"area_cm2", 3}}, {.file = "a.json"}).has_value());
    const auto read = gripFields().read(json{{"drive_v", 1}, {"area_cm2", nullptr}}, {.file = "a.json"});
    ASSERT_FALSE(read.has_value());
    EXPECT_THAT(read.error().message, HasSubstr("area_cm2"));
}

TEST(RecordFields, WhatADamagedRowDoesNotTellIsNone) {
    const json damaged{{"drive_v", 1}, {"time_s", "soon"}, {"area_cm2", "large"}};
    const auto read = gripFields().read(damaged, {.lenient = true});
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(read->drive, Volts(1));
    EXPECT_EQ(read->time, Seconds(1)) << "as it was";
    EXPECT_FALSE(read->area.has_value()) << "not 0";
}

TEST(RecordFields, NullLeavesAMemberAloneThatCannotBeEmpty) {
    RecordFields<Thing> all;
    all.number("count", &Thing::count).mayBeNull = true;
    all.record("grip", &Thing::grip, gripFields()).mayBeNull = true;
    EXPECT_EQ(all.read(json{{"count", nullptr}, {"grip", nullptr}}, {}).value(), Thing{});
    EXPECT_TRUE(all.read(json{{"count", 3}}, {}).has_value());
}

std::string refusal(const json& object) {
    const auto read = thingFields().read(object, {.file = "a.json"});
    return read ? "accepted" : read.error().message;
}

TEST(RecordFields, ReadBackWhatTheyWrite) {
    const Thing thing{
        "cup", Colour::Blue, 18446744073709551615U, 3, {Volts(5), Seconds(0.1), {}}, {{Volts(2), {}, 4.0}}};
    const auto written = thingFields().write(thing);
    EXPECT_EQ(written["seed"].dump(), "18446744073709551615") << "to the last digit";
    EXPECT_EQ(written["grips"][0].dump(), R"({"area_cm2":4.0,"drive_v":2.0,"time_s":0.0})");
    EXPECT_FALSE(written.contains("about"));
    EXPECT_EQ(thingFields().read(written, {}).value(), thing);
}

TEST(RecordFields, AMissingKeyKeepsItsValueUnlessItIsRequired) {
    EXPECT_EQ(thingFields().read(json::object(), {}).value(), Thing{});
    EXPECT_EQ(refusal({{"grips", {json::object()}}}),
              "a.json: grips[0]: \"drive_v\" is missing; a number above 0 to 10 V was expected");
}

TEST(RecordFields, RefuseWhatTheyDoNotAcceptWithItsPlace) {
    RecordProperty("hazard", "H10");
    EXPECT_EQ(refusal({{"colors", 1}}),
              "a.json: \"colors\" is not a known key; accepted are name, colour, seed, count, "
              "held_s, grips, about");
    EXPECT_EQ(refusal({{"name", ""}}), "a.json: \"name\" is \"\"; a text that is not empty was expected");
    EXPECT_EQ(refusal({{"colour", "green"}}), "a.json: \"colour\" is \"green\"; red or blue was expected");
    EXPECT_EQ(refusal({{"count", 1.5}}), "a.json: \"count\" is 1.5; a whole number from 1 to 9 was expected");
    EXPECT_EQ(refusal({{"count", 10}}), "a.json: \"count\" is 10; a whole number from 1 to 9 was expected");
    EXPECT_EQ(refusal({{"count", 7}}), "a.json: 7 is out of luck");
    EXPECT_EQ(refusal({{"count", 2.0}}), "accepted") << "a script hands on every number as a double";
    for (const json& seed : {json(-1), json(1e30), json(18446744073709551616.0), json(nullptr), json("1")})
        EXPECT_THAT(refusal({{"seed", seed}}), HasSubstr("\"seed\" is")) << seed;
    EXPECT_THAT(refusal({{"grips", {1, 2, 3}}}), HasSubstr("a list of 0 to 2 entries"));
    EXPECT_THAT(refusal({{"grips", {{{"drive_v", 11.5}}}}}),
                HasSubstr("grips[0]: \"drive_v\" is 11.5 V; a number above"));
    EXPECT_THAT(refusal({{"about", 3}}), HasSubstr("\"about\" is 3"));
    EXPECT_THAT(refusal(json::array()), HasSubstr("an object is expected"));
}

TEST(RecordFields, RefuseNanAndInfinityWhereverTheyComeFrom) {
    RecordProperty("hazard", "H1");
    for (const double value :
         {kNaN, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
        for (const char* key : {"count", "seed", "held_s"}) EXPECT_NE(refusal({{key, value}}), "accepted") << key;
        EXPECT_FALSE(gripFields().check({Volts(value), Seconds(1), {}}, {}));
        EXPECT_FALSE(gripFields().check({Volts(1), Seconds(value), {}}, {}));
        EXPECT_FALSE(gripFields().check({Volts(1), Seconds(1), value}, {}));
    }
    EXPECT_TRUE(gripFields().check({Volts(10), Seconds(0), {}}, {})) << "a closed end is accepted";
    EXPECT_FALSE(gripFields().check({Volts(0), Seconds(0), {}}, {})) << "an open one is not";
}

TEST(RecordFields, OfADamagedRowGiveWhatCanBeRead) {
    const auto thing =
        thingFields().read({{"name", 3}, {"count", 4}, {"grips", {7, {{"drive_v", 2}}}}, {"x", 1}}, {.lenient = true});
    ASSERT_TRUE(thing) << thing.error().message;
    EXPECT_EQ(thing->name, "nameless");
    EXPECT_EQ(thing->count, 4);
    ASSERT_EQ(thing->grips.size(), 2U);
    EXPECT_EQ(thing->grips[1].drive, Volts(2));
    EXPECT_TRUE(thingFields().read("damaged", {.lenient = true}));
}

TEST(RecordFields, TellAFormWhatTheyAccept) {
    const auto info = thingFields().kind().info;
    EXPECT_EQ(info.find("colour")->words, (std::vector<std::string_view>{"red", "blue"}));
    EXPECT_EQ(info.find("count")->numbers->high, 9);
    EXPECT_EQ(info.find("shape"), nullptr);
    EXPECT_TRUE(gripFields().kind().info.find("area_cm2")->mayBeNull);
}

}  // namespace
}  // namespace tacto
