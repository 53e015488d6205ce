// Tests the form for what a stimulator's certificate states and only people know.
#include <QLineEdit>
#include <gmock/gmock.h>
#include <random>

#include "app/gui/calibrate/CertificatePart.h"
#include "core/calibration/CertificateDetails.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/gui/calibrate/CalibrationLab.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

class CertificateEntries : public testing::Test {
protected:
    CertificateEntries() { static_cast<QWidget&>(part).show(); }
    gui::CertificateForm& form() {
        click(*part.findChild<QPushButton*>("certificateDetails"));
        return *part.findChild<gui::CertificateForm*>();
    }
    void keep(gui::CertificateForm& form) { click(*find<QPushButton>(form, "Keep")); }
    [[nodiscard]] bool open() { return part.findChild<gui::CertificateForm*>() != nullptr; }
    [[nodiscard]] CertificateDetails ofRun() {
        RunOrder order;
        part.fill(order);
        return certificateDetails(order.certificateDetails, utcToday()).value();
    }
    OwnDataHome home;
    gui::CertificatePart part{nullptr};
};

TEST_F(CertificateEntries, WhatIsEnteredReachesTheRunAndTheLaboratorysIsKept) {
    std::mt19937 random(49);
    CertificateDetails wanted;
    for (int round = 0; round < 4; ++round) {
        auto& entered = form();
        for (const auto& detail : kCertificateDetails) {
            const auto text = detail.isDate                              ? std::string(dateText(utcToday()))
                              : std::bernoulli_distribution(0.7)(random) ? fmt::format("{} {}", detail.title, random())
                                                                         : std::string();
            wanted.*detail.member = text;
            entered.findChild<QLineEdit*>(detail.key.data())->setText(QString::fromStdString(text));
        }
        keep(entered);
        ASSERT_IN_TIME(comesTrue([this] { return !open(); }));
        EXPECT_EQ(ofRun(), wanted) << round;
    }
    const gui::CertificatePart tomorrow(nullptr);
    RunOrder next;
    tomorrow.fill(next);
    const auto known = certificateDetails(next.certificateDetails, utcToday()).value();
    EXPECT_EQ(known.laboratory, wanted.laboratory);
    EXPECT_EQ(known.customer, "") << "the last customer is not that of the next item";
    part.forget();
    EXPECT_EQ(ofRun(), known) << "the laboratory's own stay";
}

TEST_F(CertificateEntries, EachEmptyFieldSaysWhatItWaitsFor) {
    auto& entered = form();
    for (const auto& detail : kCertificateDetails) {
        const auto* line = entered.findChild<QLineEdit*>(detail.key.data());
        EXPECT_FALSE(line->placeholderText().isEmpty()) << detail.title;
        EXPECT_LT(line->fontMetrics().horizontalAdvance(line->placeholderText()), line->width() - 16) << detail.title;
    }
}

TEST_F(CertificateEntries, ADayThatCannotBeIsSaidAndNothingIsKept) {
    RecordProperty("hazard", "H8");
    auto& entered = form();
    entered.findChild<QLineEdit*>("customer")->setText("C");
    entered.findChild<QLineEdit*>("received")->setText("2999-01-01");
    keep(entered);
    EXPECT_TRUE(open());
    EXPECT_THAT(entered.findChild<QLabel*>("certificateFormSays")->text().toStdString(),
                testing::HasSubstr("2999-01-01"));
    EXPECT_EQ(ofRun(), CertificateDetails{});
}

TEST_F(CertificateEntries, TheFormLooksRight) {
    auto& entered = form();
    ASSERT_IN_TIME(comesTrue([&] { return entered.isVisible(); }));
    looksRight(entered, "certificate_form");
}

}  // namespace
}  // namespace tacto::test
