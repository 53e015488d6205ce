// Limits, default profile and protocols are those built into the program, whatever TACTOSCOPE_RESOURCES says.
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/run/ProtocolRun.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "core/base/Csv.h"
#include "tests/support/Limits.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class Shipped : public testing::Test {
protected:
    Shipped() {
        std::filesystem::create_directories(folder_.path() / "protocols");
        std::filesystem::create_directories(folder_.path() / "limits");
        ::setenv("TACTOSCOPE_RESOURCES", folder_.path().c_str(), 1);
    }
    ~Shipped() override { ::unsetenv("TACTOSCOPE_RESOURCES"); }
    Shipped(const Shipped&) = delete;
    Shipped& operator=(const Shipped&) = delete;

    [[nodiscard]] static std::string resource(const char* file) {
        return readTextFile(sourceDir() / "resources" / file).value();
    }
    [[nodiscard]] static std::string with(std::string text, const std::string& from, const std::string& to) {
        const auto at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return text.replace(at, from.size(), to);
    }
    [[nodiscard]] static std::string refusal() {
        const auto limits = shippedLimits();
        return limits ? "accepted" : limits.error().message;
    }
    /// Adds a limit set with one row, for the peak current into the load range.
    void addSet(const std::string& id, double max_mA) {
        folder_.write(
            "limits/" + id + ".json",
            fmt::format(R"({{"id": "{}", "title": "Ours", "limits": [{{"quantity": "rms_current_5s", "max": {},
                        "unit": "mA", "compare": "<", "judged": "load_range", "action": "refuse", "window_s": 5,
                        "source": "the lab", "confidence": "high"}}]}})",
                        id, max_mA));
    }
    ScratchDir folder_;
};

TEST_F(Shipped, LimitsAreBuiltInAndNeedNoFolder) {
    RecordProperty("hazard", "H1");
    std::filesystem::remove_all(folder_.path() / "limits");
    const auto limits = shippedLimits().value();
    ASSERT_EQ(limits.sets.size(), 3U);
    const auto files = limitSets();
    for (std::size_t i = 0; i < files.size(); ++i) {
        EXPECT_EQ(limits.sets[i].id, files[i].id);
        ASSERT_EQ(limits.sets[i].rows.size(), files[i].rows.size());
        for (std::size_t k = 0; k < files[i].rows.size(); ++k)
            EXPECT_EQ(limits.sets[i].rows[k].max, files[i].rows[k].max);
        EXPECT_EQ(limits.from[i], "");
    }
    EXPECT_EQ(addedLimitsText(limits), "");
    ::setenv("TACTOSCOPE_RESOURCES", "/no/such/folder", 1);
    EXPECT_EQ(shippedLimits().value().sets.size(), 3U);
}

TEST_F(Shipped, AnotherFileCannotTakeTheirPlace) {
    RecordProperty("hazard", "H1");
    folder_.write("limits/paper.json", resource("limits/paper.json"));
    EXPECT_EQ(refusal(), "accepted") << "the same bytes";
    EXPECT_EQ(shippedLimits().value().sets.size(), 3U);
    folder_.write("limits/paper.json", with(resource("limits/paper.json"), "\"max\": 10", "\"max\": 141"));
    EXPECT_THAT(refusal(), HasSubstr("paper.json: it differs from the limit set paper"));
    std::filesystem::remove(folder_.path() / "limits/paper.json");
    folder_.write("limits/zz.json", with(resource("limits/paper.json"), "\"max\": 10", "\"max\": 141"));
    EXPECT_THAT(refusal(), HasSubstr("cannot replace it")) << "another file name is not another id";
}

TEST_F(Shipped, AFileOfLimitsIsNotReadBeyondWhatASetHas) {
    RecordProperty("hazard", "H10");
    const auto huge = folder_.write("limits/huge.json", "{}");
    std::filesystem::resize_file(huge, std::uintmax_t{1} << 40);  // the file gets longer without more content
    EXPECT_THAT(refusal(), HasSubstr("huge.json is too large; at most 1000000 bytes"));
}

TEST_F(Shipped, AnotherSetCanOnlyTightenAndIsNamed) {
    RecordProperty("hazard", "H1");
    addSet("lab", 141);
    EXPECT_THAT(refusal(), HasSubstr("lab allows rms_current_5s of 141 mA where the built-in set paper allows 10"));
    addSet("lab", 5);
    const auto limits = shippedLimits().value();
    ASSERT_EQ(limits.sets.size(), 4U);
    const auto path = (folder_.path() / "limits/lab.json").string();
    EXPECT_EQ(addedLimitsText(limits), "Limit sets in force beside the built-in ones: lab (" + path + ").");
    const auto about = aboutSession({}, {.profile = shippedProfile().value(), .limits = limits});
    ASSERT_EQ(about.limitSets.size(), 4U);
    EXPECT_EQ(about.limitSets[0].from, "");
    EXPECT_EQ(about.limitSets[3].from, path);
}

TEST_F(Shipped, TheDefaultProfileIsBuiltIn) {
    RecordProperty("hazard", "H1");
    std::filesystem::create_directories(folder_.path() / "encodings");
    folder_.write("encodings/default.json",
                  with(resource("encodings/default.json"), "\"amplitude_max_v\": 40", "\"amplitude_max_v\": 100"));
    Profile expected;  // without limits on a step, unlike the shipped profile
    expected.encoding.amplitudeRatioPerTrain = 1.2;
    expected.encoding.intervalRatioPerTrain = 1.34;
    EXPECT_EQ(toJson(shippedProfile().value()), toJson(expected));
}

TEST_F(Shipped, AProtocolOfOtherBytesIsRefusedUnderItsName) {
    RecordProperty("hazard", "H10");
    folder_.write("protocols/live.js", resource("protocols/live.js"));
    const auto text = resource("protocols/separability.js") + "\n";
    const auto changed = folder_.write("protocols/separability.js", text);
    folder_.write("protocols/ours.js", text);
    const ProtocolLibrary library;
    EXPECT_EQ(originOf(library.find("live").value()), "shipped with the program");
    EXPECT_THAT(library.find("separability").error().message,
                HasSubstr(changed.string() + ": separability is the name of a protocol that comes with the program"));
    const auto other = library.find("ours").value();
    EXPECT_FALSE(other.shipped);
    EXPECT_EQ(originOf(other), (folder_.path() / "protocols/ours.js").string());
    RunOrder order;
    order.script = other;
    EXPECT_EQ(aboutScript(order).protocolFrom, originOf(other));
}

}  // namespace
}  // namespace tacto::test
