// A certificate's details that the user enters: the laboratory's, entered once, and those of one order.
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/calibration/CertificateDetails.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

using testing::HasSubstr;

constexpr CalibrationDate kToday{std::chrono::year(2026), std::chrono::month(11), std::chrono::day(29)};

class CertificateDetailsFiles : public testing::Test {
protected:
    CertificateDetailsFiles() { setenv("XDG_DATA_HOME", folder_.path().c_str(), 1); }
    ~CertificateDetailsFiles() override { unsetenv("XDG_DATA_HOME"); }
    static std::filesystem::path write(const std::filesystem::path& file, const std::string& text) {
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file) << text;
        return file;
    }
    [[nodiscard]] std::filesystem::path order(const std::string& text) const {
        return write(folder_.path() / "order.json", text);
    }
    static std::string refused(const std::filesystem::path& file) {
        const auto read = certificateDetails(file, kToday);
        return read ? "was accepted" : read.error().message;
    }
    test::ScratchDir folder_;
};

TEST_F(CertificateDetailsFiles, NothingIsSaidWhereNobodySaidIt) {
    EXPECT_EQ(certificateDetails({}, kToday).value(), CertificateDetails{});
    EXPECT_EQ(toJson(CertificateDetails{}).dump(), "{}");
}

TEST_F(CertificateDetailsFiles, TheLaboratorysOwnAreKeptOnceAndAnOrderMaySayThemOtherwise) {
    write(certificateDetailsFile(), R"({"laboratory": "Lab Ä", "address": "Street 1", "authorised_by": "A. Weber"})");
    const auto both = certificateDetails(
        order(R"({"customer": "C", "address": "Street 2", "received": "2026-11-29", "issued": "2026-11-29"})"), kToday);
    ASSERT_TRUE(both) << both.error().message;
    EXPECT_EQ(both->laboratory, "Lab Ä");
    EXPECT_EQ(both->address, "Street 2");
    EXPECT_EQ(both->customer, "C");
    EXPECT_EQ(toJson(*both).size(), 6U) << "what is empty is not written";
    const auto alone = certificateDetails({}, kToday).value();
    EXPECT_EQ(alone.authorisedBy, "A. Weber");
    EXPECT_EQ(alone.customer, "") << "the last customer is not that of the next order";
}

TEST_F(CertificateDetailsFiles, EveryKeyIsReadAndWritten) {
    nlohmann::json all;
    for (const auto& detail : kCertificateDetails)
        all[std::string(detail.key)] = detail.isDate ? "2026-11-29" : "of " + std::string(detail.key);
    const auto read = certificateDetails(order(all.dump()), kToday);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(toJson(*read), all);
}

TEST_F(CertificateDetailsFiles, WhatAFormEntersIsKeptInBothFilesOrInNone) {
    RecordProperty("hazard", "H8");
    const auto file = folder_.path() / "item.json";
    CertificateDetails entered;
    entered.laboratory = "Lab";
    entered.customer = "C";
    ASSERT_TRUE(keepCertificateDetails(entered, file, kToday));
    EXPECT_EQ(certificateDetails(file, kToday).value(), entered);
    EXPECT_EQ(certificateDetails({}, kToday).value().customer, "");
    for (const auto wrong :
         {&CertificateDetails::customer, &CertificateDetails::issued, &CertificateDetails::laboratory}) {
        auto changed = entered;
        changed.contact = "changed";
        changed.*wrong = "1999-\n01";
        EXPECT_FALSE(keepCertificateDetails(changed, file, kToday));
        EXPECT_EQ(certificateDetails(file, kToday).value(), entered);
    }
    write(certificateDetailsFile(), "{");
    EXPECT_FALSE(keepCertificateDetails(entered, file, kToday)) << "a file that cannot be read is not replaced";
}

TEST_F(CertificateDetailsFiles, WhatIsNotAcceptedIsNamedInOneSentence) {
    RecordProperty("hazard", "H8");
    EXPECT_THAT(refused(folder_.path() / "none.json"), HasSubstr("none.json"));
    EXPECT_THAT(refused(order("[1]")), HasSubstr("an object of texts is expected"));
    EXPECT_THAT(refused(order("{")), HasSubstr("order.json"));
    EXPECT_THAT(refused(order(R"({"custumer": "C"})")),
                testing::AllOf(HasSubstr("\"custumer\" is unknown"), HasSubstr("customer, contact")));
    EXPECT_THAT(refused(order(R"({"customer": 3})")), HasSubstr("\"customer\" is 3; one line of text"));
    EXPECT_THAT(refused(order(R"({"customer": "a\nb"})")), HasSubstr("one line of text of at most 200 characters"));
    EXPECT_THAT(refused(order("{\"customer\": \"" + std::string(201, 'x') + "\"}")), HasSubstr("at most 200"));
    EXPECT_EQ(refused(order("{\"customer\": \"" + std::string(200, 'x') + "\"}")), "was accepted");
    EXPECT_THAT(refused(order(R"({"received": "29.11.2026"})")), HasSubstr("a date as \"2026-11-21\" is expected"));
    EXPECT_THAT(refused(order(R"({"received": "2026-11-30"})")), HasSubstr("after the calibration on 2026-11-29"));
    EXPECT_THAT(refused(order(R"({"issued": "2026-11-28"})")), HasSubstr("before the calibration on 2026-11-29"));
    write(certificateDetailsFile(), R"({"customer": "C"})");
    EXPECT_THAT(refused({}), HasSubstr("\"customer\" is that of an order; laboratory, address, place, authorised_by, "
                                       "function are accepted where the laboratory's own are kept"));
}

}  // namespace
}  // namespace tacto
