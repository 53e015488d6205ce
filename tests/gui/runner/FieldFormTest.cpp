// Tests the form of a protocol's parameters.
#include <QCheckBox>
#include <QComboBox>
#include <QFocusEvent>
#include <QLabel>
#include <QLineEdit>
#include <QSettings>
#include <QTest>
#include <gtest/gtest.h>
#include <map>

#include "app/gui/theme/FieldForm.h"
#include "core/base/Random.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

/// The form shows fewer digits than the script has, and the shown text would read as another value.
TEST(FieldForm, ADefaultThatWasLeftAloneIsTheScriptsWordToTheLastDigitAndBlank) {
    RecordProperty("hazard", "H9");
    ProtocolDeclaration declaration;
    ProtocolParameter area;
    area.name = area.label = "area";
    area.value = 4.00000000001;
    ProtocolParameter file;
    file.name = file.label = "file";
    file.type = ParameterType::File;
    file.value = "/some/path ";
    declaration.parameters = {area, file};
    gui::FieldForm form;
    form.show(declaration);
    const auto untouched = form.read().value();
    EXPECT_TRUE(untouched.given.empty());
    EXPECT_EQ(untouched.parameters.at("area"), area.value);
    EXPECT_EQ(untouched.parameters.at("file"), file.value);
    form.set("area", "5");
    form.set("file", "/another");
    const auto chosen = form.read().value();
    EXPECT_EQ(chosen.given, (std::set<std::string>{"area", "file"}));
    EXPECT_EQ(chosen.parameters.at("area"), 5);
}

/// Types a text into a line as a person does, and leaves the line.
void typeInto(QLineEdit& line, const QString& text) {
    line.setFocus();
    line.selectAll();
    QTest::keyClicks(&line, text);
    QTest::keyClick(&line, Qt::Key_Return);
}

void emptyWithEnter(QLineEdit& line) {
    line.selectAll();
    QTest::keyClick(&line, Qt::Key_Delete);
    QTest::keyClick(&line, Qt::Key_Return);
}

void forgetElectrodes() {
    QSettings().remove("electrodeAreas");
    QSettings().remove("electrode");
}

TEST(FieldForm, AnElectrodesAreaIsRememberedWithItsNameInEveryForm) {
    RecordProperty("hazard", "H9");
    forgetElectrodes();
    Random random(54, "electrodes");
    const QStringList names{"Pad, 5 cm", "pad 5 cm", "Ring/steel", "Elektrode µ", "A", "AB"};
    std::map<QString, QString> expected;
    for (int step = 0; step < 60; ++step) {
        const char* keys[] = {"area", "electrode_area_cm2", "electrode.area_cm2"};
        const std::string key = keys[random.below(3)];
        gui::FieldForm form;
        form.show({gui::numberField(key.c_str(), "Area", "cm2", 0, 1000, 7, "")});
        form.setVisible(true);
        auto& area = *form.findChild<QLineEdit*>(QString::fromStdString(key));
        auto& box = *form.findChild<QComboBox*>("electrode");
        const auto remembered = [&box] {
            box.showPopup();
            box.hidePopup();
            return std::size_t(box.count());
        };
        const auto& name = names[int(random.below(std::uint64_t(names.size())))];
        typeInto(*box.lineEdit(), name);
        const auto typed = QString::number(double(1 + random.below(900)) / 10);
        if (const auto known = expected.find(name); known != expected.end()) {
            ASSERT_EQ(area.text(), known->second) << name.toStdString();
            EXPECT_EQ(form.text(key), known->second);
            if (random.below(2) == 0) {
                emptyWithEnter(area);
                EXPECT_EQ(box.currentText(), name);
                typeInto(area, known->second = typed);
            }
        } else {
            ASSERT_EQ(remembered(), expected.size()) << "what stood beside it is not its own";
            if (random.below(2) == 0) {
                QTest::keyClick(&area, Qt::Key_Return);  // says that it is
                expected[name] = "7";
            } else {
                typeInto(area, random.below(2) == 0 ? "nonsense" : "-3");  // is kept with none
                ASSERT_EQ(remembered(), expected.size());
                typeInto(area, expected[name] = typed);
            }
        }
        EXPECT_EQ(box.currentText(), name);
        if (random.below(2) == 0) {
            typeInto(area, random.below(2) == 0 ? "nonsense" : "901");
            EXPECT_EQ(box.currentText(), "") << "it is not the area of " << name.toStdString();
        }
        ASSERT_EQ(remembered(), expected.size());
        gui::FieldForm next;
        next.show({gui::numberField("area", "Area", "cm2", 0, 1000, expected[name].toDouble(), "")});
        EXPECT_EQ(next.findChild<QComboBox*>("electrode")->currentText(), name) << "it is the one of this area";
        next.set("area", "901");
        EXPECT_EQ(next.findChild<QComboBox*>("electrode")->currentText(), "");
    }
    EXPECT_EQ(gui::FieldForm().findChild<QComboBox*>("electrode"), nullptr);
}

/// The line of the area stands above the name, so people type the area first.
TEST(FieldForm, AnAreaTypedBeforeAnotherElectrodeIsNamedChangesNeither) {
    RecordProperty("hazard", "H1");
    RecordProperty("hazard", "H9");
    forgetElectrodes();
    gui::FieldForm form;
    form.show({gui::numberField("area", "Area", "cm2", 0, 1000, 7, "")});
    form.setVisible(true);
    auto& area = *form.findChild<QLineEdit*>("area");
    auto& box = *form.findChild<QComboBox*>("electrode");
    typeInto(*box.lineEdit(), "A");
    typeInto(area, "4");
    typeInto(area, "9");
    EXPECT_EQ(box.currentText(), "");
    typeInto(*box.lineEdit(), "B");
    EXPECT_EQ(area.text(), "9");
    typeInto(*box.lineEdit(), "A");
    EXPECT_EQ(area.text(), "4");
    typeInto(*box.lineEdit(), "B");
    EXPECT_EQ(QSettings().value("electrodeAreas").toMap(), (QVariantMap{{"A", "4"}}));
}

TEST(FieldForm, ADecimalCommaIsReadAndAnUncertainOneIsRefusedWithItsReason) {
    gui::FieldForm form;
    form.show({gui::numberField("load", "Load", "ohm", 1, 1e6, 1000, "")});
    form.set("load", "4,5 kohm");
    EXPECT_EQ(form.read().value().parameters.at("load"), 4500);
    form.set("load", "1,000");
    const auto refused = form.read();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::InvalidArgument);
    EXPECT_NE(refused.error().message.find("may be 1.000 or 1000"), std::string::npos) << refused.error().message;
}

TEST(FieldForm, ATickSaysYesByItself) {
    ProtocolDeclaration declaration;
    ProtocolParameter keep;
    keep.name = "keep";
    keep.label = "Keep the captures";
    keep.type = ParameterType::Boolean;
    keep.value = true;
    declaration.parameters = {keep};
    gui::FieldForm form;
    form.show(declaration);
    const auto* box = form.findChild<QCheckBox*>("keep");
    ASSERT_NE(box, nullptr);
    EXPECT_TRUE(box->isChecked());
    EXPECT_EQ(box->accessibleName(), "Keep the captures");
    form.resize(400, 100);
    form.setVisible(true);
    QLabel* label = nullptr;
    for (auto* one : form.findChildren<QLabel*>())
        if (one->text() == "Keep the captures") label = one;
    ASSERT_NE(label, nullptr);
    ASSERT_IN_TIME(comesTrue([&] { return label->isVisible() && box->isVisible(); }));
    const auto middle = [](const QWidget& of) { return of.mapToGlobal(of.rect().center()); };
    EXPECT_NEAR(middle(*label).y(), middle(*box).y(), 4) << "in one line";
    EXPECT_GT(middle(*label).x(), middle(*box).x());
    QTest::mouseClick(label, Qt::LeftButton);
    EXPECT_FALSE(box->isChecked()) << "its words are part of it";
}

TEST(FieldForm, AChoiceOfALoadHasTheSignOfItsUnit) {
    ProtocolDeclaration declaration;
    ProtocolParameter load;
    load.name = "reference";
    load.label = "Known load";
    load.type = ParameterType::Choice;
    load.choices = {{"1 kohm", ""}, {"100 ohm", ""}};
    load.value = "1 kohm";
    declaration.parameters = {load};
    gui::FieldForm form;
    form.show(declaration);
    EXPECT_EQ(form.findChild<QComboBox*>("reference")->currentText(), "1 kΩ");
    EXPECT_EQ(form.text("reference"), "1 kohm") << "the script's own word";
}

ProtocolParameter areaFromTheProfile() {
    ProtocolParameter area;
    area.name = "area";
    area.label = "Area of the smallest electrode";
    area.unit = "cm2";
    area.min = 0;
    area.max = 1000;
    area.value = 0;
    area.zero = "from the profile";
    return area;
}

TEST(FieldForm, FieldsWithARangeEndInOneLine) {
    ProtocolDeclaration declaration;
    auto area = areaFromTheProfile();
    auto load = area;
    load.name = "load";
    load.max = 1'000'000;
    declaration.parameters = {area, load};
    gui::FieldForm form;
    form.show(declaration);
    form.resize(400, form.sizeHint().height());
    form.setVisible(true);
    std::set<int> ends;
    for (const auto* name : {"area", "load"}) {
        const auto* field = form.findChild<QLineEdit*>(name);
        ends.insert(field->mapTo(&form, QPoint(field->width(), 0)).x());
    }
    EXPECT_EQ(ends.size(), 1U);
    EXPECT_LT(*ends.begin(), 400) << "the ranges have no room";
}

TEST(FieldForm, ALargeRangeIsReadInGroupsAndARefusalNamesNoParameterOfTheScript) {
    ProtocolDeclaration declaration;
    auto load = areaFromTheProfile();
    load.name = "load";
    load.label = "Load";
    load.unit = "ohm";
    load.min = 1;
    load.max = 1'000'000;
    load.value = 1000;
    load.zero.clear();
    declaration.parameters = {load};
    gui::FieldForm form;
    form.show(declaration);
    const auto shown = [&](const char* words) {
        for (const auto* label : form.findChildren<QLabel*>())
            if (label->text().contains(words)) return true;
        return false;
    };
    EXPECT_TRUE(shown("1 to 1\u202f000\u202f000"));
    form.findChild<QLineEdit*>("load")->setText("0");
    EXPECT_TRUE(shown("This is 0, a number from 1 to 1\u202f000\u202f000 Ω is expected."))
        << form.findChild<QLabel*>("trouble-load")->text().toStdString();
}

TEST(FieldForm, WhatZeroStandsForIsSaidInAnEmptyField) {
    ProtocolDeclaration declaration;
    declaration.parameters = {areaFromTheProfile()};
    gui::FieldForm form;
    form.show(declaration);
    auto* area = form.findChild<QLineEdit*>("area");
    EXPECT_EQ(area->text(), "");
    EXPECT_EQ(area->placeholderText(), "from the profile");
    const auto untouched = form.read().value();
    EXPECT_EQ(untouched.parameters.at("area"), 0);
    EXPECT_TRUE(untouched.given.empty());
    area->setText("4");
    EXPECT_EQ(form.read().value().parameters.at("area"), 4);
    area->clear();
    EXPECT_EQ(form.read().value().parameters.at("area"), 0);

    declaration.parameters[0].needed = "density is not evaluated";
    form.show(declaration);
    area = form.findChild<QLineEdit*>("area");
    EXPECT_EQ(area->placeholderText(), "not stated") << "the profile has none";
    form.setKnown({"area"});
    EXPECT_EQ(area->placeholderText(), "from the profile");
}

TEST(FieldForm, WhatIsMissingIsSaidOnceTheFieldWasLeftOrTheFormWasTried) {
    ProtocolDeclaration declaration;
    for (const char* name : {"title", "reference"}) {
        ProtocolParameter text;
        text.name = text.label = name;
        text.type = ParameterType::Text;
        text.value = "";
        text.needed = "no session can begin";
        declaration.parameters.push_back(text);
    }
    gui::FieldForm form;
    form.setMissingSaidOnceLeft();
    form.show(declaration);
    static_cast<QWidget&>(form).show();
    form.activateWindow();
    ASSERT_IN_TIME(QTest::qWaitForWindowActive(&form));
    const auto says = [&](const char* name) {
        return form.findChild<QLabel*>(QString("trouble-") + name)->isVisible();
    };
    auto* title = form.findChild<QLineEdit*>("title");
    title->setFocus();
    EXPECT_FALSE(says("title"));
    EXPECT_FALSE(form.unanswered().isEmpty()) << "and is known all the same";
    EXPECT_EQ(form.refused(false), 2);
    QTest::keyClicks(title, "x");
    QTest::keyClick(title, Qt::Key_Backspace);
    EXPECT_FALSE(says("title")) << "while it is typed";
    QTest::keyClick(title, Qt::Key_Tab);
    EXPECT_TRUE(says("title"));
    EXPECT_FALSE(says("reference"));
    EXPECT_TRUE(form.goToRefused());
    EXPECT_TRUE(says("reference"));
    form.set("reference", "EC-1");
    EXPECT_FALSE(says("reference"));
    form.show(declaration);
    EXPECT_FALSE(says("title")) << "a new form";
}

TEST(FieldForm, ARefusalOfItsOwnerStaysUntilTheFieldIsEdited) {
    gui::FieldForm form;
    form.show({gui::textField("load", "&Load", "1 kohm", "What is connected."),
               gui::numberField("gain", "Gain", "", 0.5, 1.5, 1, "Delivered over commanded.")});
    auto* load = form.findChild<QLineEdit*>("load");
    const auto* trouble = form.findChild<QLabel*>("trouble-load");
    EXPECT_EQ(load->accessibleName(), "Load");
    form.refuse("load", "It is open.");
    QFocusEvent leaves(QEvent::FocusOut, Qt::TabFocusReason);
    QCoreApplication::sendEvent(load, &leaves);
    EXPECT_TRUE(trouble->text().contains("It is open."));
    EXPECT_EQ(form.refused(false), 1);
    EXPECT_TRUE(form.read()) << "its owner judges it";
    load->setText("2 kohm");
    EXPECT_TRUE(trouble->isHidden());
    EXPECT_EQ(form.refused(false), 0);
    form.refuse("load", {});
    for (const auto* outside : {"0.49", "1.51", "nan", "inf", "", "1,200"}) {
        form.set("gain", outside);
        EXPECT_FALSE(form.read()) << outside;
        EXPECT_EQ(form.refused(false), 1) << outside;
    }
}

TEST(FieldForm, WhatWasChosenStaysWhereOtherChoicesStillHaveIt) {
    gui::FieldForm form;
    form.show({gui::choiceField("probe", "Probe", {{"", "none"}, {"P1", "P1"}}, {})});
    int edits = 0;
    QObject::connect(&form, &gui::FieldForm::edited, [&] { ++edits; });
    form.set("probe", "P1");
    form.setChoices("probe", {{"", "none"}, {"P0", "P0"}, {"P1", "P1 (expired)"}});
    EXPECT_EQ(form.text("probe"), "P1");
    EXPECT_EQ(form.findChild<QComboBox*>("probe")->currentText(), "P1 (expired)");
    form.setChoices("probe", {{"", "none"}, {"P0", "P0"}});
    EXPECT_EQ(form.text("probe"), "");
    EXPECT_EQ(edits, 3) << "each is told, as a new choice may be another";
    form.set("probe", "P0");
    EXPECT_EQ(form.read().value().parameters.at("probe"), "P0");
}

}  // namespace
}  // namespace tacto::test
