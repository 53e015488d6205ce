// Every sampling rate that a shipped protocol offers leads to its verdict, with a flawed and with an ideal
// oscilloscope.
#include <gtest/gtest.h>

#include "tests/scripting/RunBench.h"

namespace tacto {
namespace {

using test::RunBench;

struct Offer {
    std::string protocol;
    std::vector<Role> needs;
    std::string rate;
};

std::vector<Offer> offeredRates() {
    std::vector<Offer> offers;
    for (const auto& source : ProtocolLibrary(test::sourceDir() / "resources" / "protocols", {}).list()) {
        const auto declared = readDeclaration(source).value();
        for (const auto& parameter : declared.parameters) {
            if (parameter.name != "rate" || parameter.type != ParameterType::Choice) continue;
            for (const auto& [rate, label] : parameter.choices) {
                offers.push_back({source.name, {declared.needs.begin(), declared.needs.end()}, rate});
            }
        }
    }
    return offers;
}

/// Returns the shortest settings that still lead to a verdict.
std::map<std::string, std::string> shortened(const Offer& offer) {
    std::map<std::string, std::string> settings{{"rate", offer.rate}};
    if (offer.protocol == "separability") settings.insert({"repeats", "2"});
    if (offer.protocol == "stimulator-calibration") {
        settings.insert({{"levels", "3"}, {"repeats", "2"}, {"warm_up_s", "0"}});
    }
    return settings;
}

class OfferedRates : public ::testing::TestWithParam<std::string> {};

TEST_P(OfferedRates, LeadToAVerdict) {
    RecordProperty("hazard", "H9");
    const auto offers = offeredRates();
    EXPECT_GE(offers.size(), 10U) << "those of separability and of stimulator-calibration";
    for (const auto& offer : offers) {
        SCOPED_TRACE(offer.protocol + " at " + offer.rate);
        RunBench rig(true, GetParam(), 1, false, {offer.needs.begin(), offer.needs.end()});
        const auto outcome = runProtocol(rig.shipped(offer.protocol, shortened(offer))).value();
        EXPECT_FALSE(outcome.error) << outcome.error->message;
        EXPECT_TRUE(outcome.verdict == ScriptVerdict::Pass || outcome.verdict == ScriptVerdict::Indeterminate)
            << nameOf(outcome.verdict) << outcome.results.dump();
        EXPECT_TRUE(rig.outputOff());
    }
}

INSTANTIATE_TEST_SUITE_P(Twins, OfferedRates, ::testing::Values("sim:", "sim:oscilloscope?flaws=none"),
                         [](const auto& tested) { return tested.param == "sim:" ? "WithFlaws" : "Ideal"; });

}  // namespace
}  // namespace tacto
