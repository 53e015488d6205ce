// OpenedStudy.h - a study in a scratch folder whose keys are quick to derive, and the page that shows it.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QTest>
#include <filesystem>
#include <gmock/gmock.h>

#include "app/gui/study/OpenStudy.h"
#include "app/gui/study/PassphraseDialog.h"
#include "app/gui/study/StudyList.h"
#include "app/gui/study/StudyPage.h"
#include "app/run/Shipped.h"
#include "app/run/StudyProgram.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {

inline constexpr const char* kWords = "correct horse 4711";

class StudyInThePage : public testing::Test {
protected:
    /// `cheap`: quick keys in a separate place; otherwise keys where the command line's program finds them.
    explicit StudyInThePage(bool cheap = true) : cheap_(cheap) {
        page.resize(1100, 640);
        page.show();
        EXPECT_IN_TIME(QTest::qWaitForWindowExposed(&page));
    }
    [[nodiscard]] static StudySettings settings() {
        StudySettings made;
        made.title = "Four conditions";
        made.approval.reference = "EC-2026-17";
        made.approval.from = std::chrono::year(2020) / 1 / 1;
        made.approval.expires = std::chrono::year(2090) / 12 / 31;
        made.consentVersion = "2";
        made.painCeiling = kPainCeiling;
        made.ageMin = kAgeMin;
        EXPECT_TRUE(stateProgram(made, shippedProfile().value()));
        return made;
    }
    [[nodiscard]] QString folder() const { return QString::fromStdString((scratch.path() / "study").string()); }
    [[nodiscard]] Study::Surroundings around() const {
        if (!cheap_) return {};
        return {&SystemTime::real(), scratch.path() / "keys", PassphraseCost::least()};
    }
    /// Makes the study elsewhere and closes it.
    void make() {
        const auto words = Passphrase::from(kWords).value();
        const auto made = Study::create(folder().toStdString(), settings(), words, around());
        ASSERT_TRUE(made) << made.error().message;
    }
    [[nodiscard]] QDialog* dialog(const char* name) const {
        for (auto* widget : QApplication::topLevelWidgets()) {
            if (widget->isVisible() && widget->objectName() == name) return qobject_cast<QDialog*>(widget);
        }
        return nullptr;
    }
    void open() {
        page.open(folder());
        ASSERT_IN_TIME(comesTrue([this] { return dialog("passphraseDialog") != nullptr; }));
        auto* asks = dialog("passphraseDialog");
        QTest::keyClicks(asks->findChild<QLineEdit*>("passphrase"), kWords);
        click(*asks->findChild<QPushButton*>("usePassphrase"));
        ASSERT_IN_TIME(comesTrue([this] { return study.study() != nullptr; }));
        ASSERT_IN_TIME(comesTrue([this] { return dialog("passphraseDialog") == nullptr; }));
    }
    void press(const char* name) { click(*page.findChild<QPushButton*>(name)); }
    void choose(const char* action) { page.findChild<QAction*>(action)->trigger(); }
    [[nodiscard]] std::string cell(const char* table, int row, int column) const {
        return page.findChild<QTableWidget*>(table)->item(row, column)->text().toStdString();
    }

    const bool cheap_;
    ScratchDir scratch;
    gui::OpenStudy study{nullptr, around()};
    gui::StudyPage page{study};
};

}  // namespace tacto::test
