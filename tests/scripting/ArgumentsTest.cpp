// Tests what the dispatcher refuses before it calls a host function, for every parameter of every function.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "app/scripting/engine/Arguments.h"

namespace tacto {
namespace {

using Json = nlohmann::json;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Returns a value that the parameter accepts.
Json sampleOf(const HostParameter& parameter) {
    switch (parameter.type) {
        case ValueType::Number:
        case ValueType::Whole:
            return parameter.numbers.high < 1e300   ? parameter.numbers.high
                   : parameter.numbers.low > -1e300 ? parameter.numbers.low + 1
                                                    : 1;
        case ValueType::Text:
            return parameter.words.empty() ? "a" : std::string(parameter.words.front());
        case ValueType::Flag:
            return true;
        case ValueType::List:
            return Json::array();
        case ValueType::Object:
        case ValueType::Any:
            return Json::object();
        case ValueType::Load:
            return 500;
    }
    return {};
}

const std::vector<HostParameter>& passedTo(const HostFunction& function) {
    return function.passes.empty() ? function.parameters : function.passes;
}

/// Returns the place of a parameter in `list`. The last element of `list` is the argument that contains the parameter.
Json& placeOf(Json& list, const std::string& name) {
    Json* at = &list.back();
    for (auto from = name.find('.'); from < name.size();) {
        const auto to = std::min(name.find('.', from + 1), name.size());
        at = &(*at)[name.substr(from + 1, to - from - 1)];
        from = to;
    }
    return *at;
}

/// Returns valid arguments, with `value` for the parameter `name`.
Json argumentsWith(const HostFunction& function, std::string_view name = {}, const Json& value = {}) {
    Json list = Json::array();
    std::string last;
    for (const auto& parameter : passedTo(function)) {
        const std::string own(parameter.name), root = own.substr(0, own.find('.'));
        if (root != last) list.push_back(nullptr);
        last = root;
        const bool isWithin = !name.empty() && own.starts_with(std::string(name) + ".");
        if (!isWithin) placeOf(list, own) = parameter.name == name ? value : sampleOf(parameter);
    }
    return list;
}

std::string refusalOf(const HostFunction& function, const Json& list) {
    const auto checked = Arguments::check(function, list);
    return checked ? "" : checked.error().message;
}

std::string spoken(const HostParameter& parameter) {
    const std::string name(parameter.name);
    return name.starts_with("options.") ? name.substr(8) : name;
}

TEST(Arguments, WhatTheTablesDescribeIsAccepted) {
    for (const auto& function : hostFunctions()) {
        if (function.fullName() == "protocol") continue;  // protocol() is read before the run
        EXPECT_EQ(refusalOf(function, argumentsWith(function)), "") << function.fullName();
    }
}

TEST(Arguments, AreRefusedForWrongTypeNanInfinityAndRangeInOneSentence) {
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    for (const auto& function : hostFunctions()) {
        for (const auto& parameter : passedTo(function)) {
            std::vector<Json> bad;
            switch (parameter.type) {
                case ValueType::Number:
                case ValueType::Whole:
                    bad = {infinity, -infinity, "x", Json::object(), true};
                    if (!parameter.mayBeNull) bad.push_back(nan);
                    if (parameter.numbers.high < 1e300)
                        bad.push_back(parameter.numbers.high + std::max(1.0, std::abs(parameter.numbers.high)));
                    if (parameter.numbers.high < 1e300) bad.push_back(1e300);
                    if (parameter.numbers.low > -1e300)
                        bad.push_back(parameter.numbers.low - std::max(1.0, std::abs(parameter.numbers.low)));
                    if (parameter.type == ValueType::Whole) bad.push_back(parameter.numbers.low + 0.5);
                    break;
                case ValueType::Text:
                    bad = {1, true, Json::array()};
                    if (!parameter.words.empty()) bad.push_back("no such word");
                    if (parameter.mostCharacters > 0) bad.push_back(std::string(parameter.mostCharacters + 1, 'a'));
                    break;
                case ValueType::Flag:
                    bad = {1, "true", Json::object()};
                    break;
                case ValueType::List:
                    bad = {1, "x", Json::object()};
                    if (parameter.items != ValueType::Any)
                        bad.push_back(Json::array({parameter.items == ValueType::Number ? Json("x") : Json(1)}));
                    break;
                case ValueType::Object:
                    bad = {1, "x", Json::array()};
                    break;
                case ValueType::Load:
                    bad = {0, -5, nan, infinity, true, "no load"};
                    break;
                case ValueType::Any:
                    break;
            }
            for (const auto& value : bad) {
                const auto refusal = refusalOf(function, argumentsWith(function, parameter.name, value));
                if (parameter.type == ValueType::Load && value.is_string()) {
                    EXPECT_NE(refusal, "");
                    continue;
                }
                EXPECT_THAT(refusal, StartsWith(function.fullName() + ": " + spoken(parameter) + " is "));
                EXPECT_THAT(refusal, EndsWith(" is expected"));
            }
        }
    }
}

TEST(Arguments, AQuestionToTheOperatorIsNoLongerThanAWindowShows) {
    for (const auto& function : hostFunctions()) {
        for (const auto& parameter : passedTo(function)) {
            if (function.object != "operator" || parameter.name != "text") continue;
            EXPECT_EQ(parameter.accepted(), "a text of at most 2000 characters") << function.fullName();
        }
    }
}

TEST(Arguments, AreRefusedWhereOneIsMissing) {
    for (const auto& function : hostFunctions()) {
        for (const auto& parameter : passedTo(function)) {
            if (parameter.mayBeLeftOut || parameter.mayBeNull || parameter.type == ValueType::Any) continue;
            if (function.fullName() == "protocol") continue;
            EXPECT_THAT(refusalOf(function, argumentsWith(function, parameter.name, Json())),
                        HasSubstr(spoken(parameter) + " is nothing, " + parameter.accepted()))
                << function.fullName();
        }
    }
}

TEST(Arguments, AreRefusedForAnOptionThatThereIsNot) {
    for (const auto& function : hostFunctions()) {
        auto list = argumentsWith(function);
        if (passedTo(function).empty() || !passedTo(function).back().name.starts_with("options.")) continue;
        list.back()["no_such_option"] = 1;
        EXPECT_THAT(refusalOf(function, list),
                    StartsWith(function.fullName() + ": \"no_such_option\" is not a known key; accepted are "));
        list.back() = 3;
        EXPECT_THAT(refusalOf(function, list), HasSubstr("the options is 3, an object is expected"));
    }
}

TEST(Arguments, WholeNumbersFitAnInt) {
    for (const auto& function : hostFunctions()) {
        for (const auto& parameter : passedTo(function)) {
            if (parameter.type != ValueType::Whole) continue;
            EXPECT_GE(parameter.numbers.low, std::numeric_limits<int>::lowest()) << function.fullName();
            EXPECT_LE(parameter.numbers.high, std::numeric_limits<int>::max()) << function.fullName();
        }
    }
}

TEST(Arguments, DefaultsAreWhatTheReferenceSays) {
    for (const auto& function : hostFunctions()) {
        for (const auto& parameter : passedTo(function)) {
            if (parameter.usual.is_null()) continue;
            EXPECT_TRUE(parameter.accepts(parameter.usual)) << function.fullName() << ": " << parameter.name;
        }
    }
}

}  // namespace
}  // namespace tacto
