// Tests the design's rules on colour: lines also differ by dash, text is legible, only STOP and faults are red.
#include <QAccessible>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QFile>
#include <QFontInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollArea>
#include <QSlider>
#include <QSpinBox>
#include <QTabBar>
#include <QTableWidget>
#include <QTest>
#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>

#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/ToolRow.h"
#include "app/gui/theme/VerdictBlock.h"
#include "app/report/VerdictMark.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using gui::Theme;

class InTheme : public testing::TestWithParam<Theme> {
protected:
    InTheme() { gui::applyTheme(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Both, InTheme, testing::Values(Theme::Light, Theme::Dark),
                         [](const auto& theme) { return theme.param == Theme::Dark ? "Dark" : "Light"; });

/// True for hues that a person calls red, like STOP's; not for vermilion (#D55E00) and purple (#CC79A7).
bool isRed(const QColor& colour) {
    return colour.hsvSaturationF() > 0.4 && (colour.hsvHue() >= 345 || (colour.hsvHue() >= 0 && colour.hsvHue() <= 12));
}

TEST(Verdicts, AreTheSameOnScreenAndOnPaper) {
    gui::applyTheme(Theme::Light);
    for (const char* key : {"pass", "fail", "indeterminate", "stopped", "attention", "refused as expected",
                            "not evaluated", "not applicable", ""}) {
        const auto screen = gui::verdictStyle(key);
        const auto paper = verdictMark(QString(key));
        EXPECT_EQ(screen.shape.toStdString(), paper.shape.toStdString()) << key;
        EXPECT_EQ(screen.fill, paper.fill) << key;
        EXPECT_EQ(screen.ink, paper.ink) << key;
        EXPECT_EQ(screen.colour, paper.colour) << key;
        EXPECT_GE(contrast(paper.fill, paper.ink), 4.5) << key;
        EXPECT_GE(contrast(Qt::white, paper.colour), 4.5) << key;
    }
}

TEST_P(InTheme, AVerdictsWordIsReadAfterTheThemeHasChanged) {
    const auto other = GetParam() == Theme::Light ? Theme::Dark : Theme::Light;
    for (const char* key : {"pass", "fail", "indeterminate", "stopped", "error", ""}) {
        gui::applyTheme(other);
        gui::VerdictBlock block(nullptr);
        block.setVerdict(key);
        block.resize(block.sizeHint());
        block.show();
        static_cast<void>(block.grab());
        gui::applyTheme(GetParam());
        const auto style = gui::verdictStyle(key);
        EXPECT_GE(contrast(style.ink, style.fill), 4.5) << key;
        const auto picture = block.grab().toImage();
        EXPECT_GT(pixelsOf(picture, style.fill), picture.width() * picture.height() / 2) << key;
        EXPECT_GT(pixelsOf(picture, style.ink), 100) << key;
    }
}

TEST(Looks, AreFoundWrongWhereTheyAre) {
    gui::applyTheme(Theme::Light);
    QWidget window;
    auto* layout = new QVBoxLayout(&window);
    auto* label = new QLabel("a long sentence that has no room", &window);
    auto* button = new QPushButton("Press", &window);
    layout->addWidget(label);
    layout->addWidget(button);
    window.show();
    EXPECT_TRUE(cutTexts(window).isEmpty() && paleTexts(window).isEmpty() && overlaps(window).isEmpty());
    label->setFixedWidth(20);
    auto pale = label->palette();
    pale.setColor(QPalette::WindowText, QColor("#b0b0b0"));
    label->setPalette(pale);
    QCoreApplication::processEvents();
    button->move(label->pos());
    EXPECT_EQ(cutTexts(window).size(), 1);
    EXPECT_EQ(paleTexts(window).size(), 1);
    EXPECT_EQ(overlaps(window).size(), 1);
}

TEST(Type, IsNotoSansAndItsSignsFromFacesThatHaveThem) {
    EXPECT_EQ(QApplication::font().families(), QStringList({"Noto Sans", "Noto Sans Math", "DejaVu Sans"}));
    EXPECT_EQ(QFontInfo(QApplication::font()).family(), "Noto Sans") << "fonts-noto-core is needed";
}

TEST(TurningRow, PutsItsPartsBelowEachOtherWhereThereIsNoRoom) {
    QWidget page;
    auto* row = new gui::TurningRow([] { return 300; }, &page);
    auto* first = new QLabel("first", &page);
    auto* second = new QLabel("second", &page);
    for (auto* part : {first, second}) row->addWidget(part);
    row->setContentsMargins(0, 0, 0, 0);
    page.show();
    for (const int width : {400, 200, 300, 299}) {
        page.resize(width, 200);
        const bool beside = width >= 300;
        EXPECT_IN_TIME(comesTrue([&] { return (first->y() == second->y()) == beside; })) << width;
        EXPECT_IN_TIME(comesTrue([&] { return (first->x() == second->x()) == !beside; })) << width;
        EXPECT_EQ(row->direction() == QBoxLayout::LeftToRight, beside) << width;
    }
}

TEST(TurningRow, AsksForTheWidthOfItsWidestPartAndCanAlwaysTurn) {
    QWidget page;
    auto* row = new gui::TurningRow({}, &page);
    for (const int width : {300, 200}) {
        auto* part = new QWidget(&page);
        part->setMinimumSize(width, 20);
        row->addWidget(part);
    }
    row->setContentsMargins(4, 0, 4, 0);
    row->setSpacing(8);
    EXPECT_EQ(row->minimumSize().width(), 308);
    EXPECT_GE(row->sizeHint().width(), 508);
    page.show();
    page.resize(600, 100);
    EXPECT_IN_TIME(comesTrue([&] { return row->direction() == QBoxLayout::LeftToRight; }));
    page.resize(400, 100);
    EXPECT_IN_TIME(comesTrue([&] { return row->direction() == QBoxLayout::TopToBottom; }));
    EXPECT_EQ(page.width(), 400);
    EXPECT_GE(row->sizeHint().width(), 508) << "beside each other again where there is room";
}

TEST(PageStack, AsksForTheRoomOfThePageThatIsShown) {
    gui::PageStack stack;
    auto* narrow = new QLabel(QString("words that wrap ").repeated(20), &stack);
    narrow->setWordWrap(true);
    narrow->setMinimumWidth(100);
    auto* wide = new QWidget(&stack);
    wide->setMinimumSize(900, 700);
    stack.addWidget(narrow);
    stack.addWidget(wide);
    EXPECT_EQ(stack.minimumSizeHint().width(), 100);
    EXPECT_LT(stack.minimumSizeHint().height(), 700);
    EXPECT_TRUE(stack.hasHeightForWidth());
    stack.setCurrentIndex(1);
    EXPECT_EQ(stack.currentWidget(), wide);
    EXPECT_EQ(stack.minimumSizeHint(), QSize(900, 700));
    EXPECT_FALSE(stack.hasHeightForWidth());
    QWidget around;
    auto* column = new QVBoxLayout(&around);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(&stack);
    EXPECT_EQ(column->minimumSize(), QSize(900, 700));
    around.show();
    stack.setCurrentIndex(0);
    EXPECT_IN_TIME(comesTrue([&] { return column->minimumSize().width() == 100; })) << "what is around it follows";
    stack.setParent(nullptr);
}

TEST(Conditions, HaveTheColoursOfTheSetAndADashEach) {
    gui::applyTheme(Theme::Light);
    const std::tuple<const char*, const char*, Qt::PenStyle> all[] = {{"smooth-low", "#56b4e9", Qt::DotLine},
                                                                      {"smooth-high", "#0072b2", Qt::DashLine},
                                                                      {"rough-low", "#e69f00", Qt::DashDotLine},
                                                                      {"rough-high", "#d55e00", Qt::SolidLine}};
    std::set<int> markers;
    for (const auto& [name, colour, dash] : all) {
        const auto style = gui::conditionInTheme(name);
        EXPECT_EQ(style.color.name().toStdString(), colour) << name;
        EXPECT_EQ(style.dash, dash) << name;
        markers.insert(style.marker);
    }
    EXPECT_EQ(markers.size(), 4U) << "points are told apart by shape";
    EXPECT_EQ(gui::colours().voltage.name().toStdString(), "#0072b2");
    EXPECT_EQ(gui::colours().current.name().toStdString(), "#009e73");
}

TEST_P(InTheme, ConditionsAndChannelsStandOutFromThePlot) {
    for (const auto* name : {"smooth-low", "smooth-high", "rough-low", "rough-high"})
        EXPECT_GE(contrast(gui::conditionInTheme(name).color, gui::colours().base), 2) << name;
    for (const auto& channel : {gui::colours().voltage, gui::colours().current, gui::colours().third})
        EXPECT_GE(contrast(channel, gui::colours().base), 3) << channel.name().toStdString();
}

TEST(Looks, AreFoundWrongInBoxesTabsAndTitlesOfColumns) {
    gui::applyTheme(Theme::Light);
    QWidget window;
    auto* layout = new QVBoxLayout(&window);
    auto* box = new QComboBox(&window);
    box->addItem("a choice of several words");
    auto* tabs = new QTabBar(&window);
    tabs->setExpanding(false);
    tabs->setUsesScrollButtons(false);
    tabs->addTab("The first of them");
    tabs->addTab("The second of them");
    auto* table = new QTableWidget(1, 2, &window);
    table->setHorizontalHeaderLabels({"Quantity", "Uncertainty"});
    for (QWidget* each : {static_cast<QWidget*>(box), static_cast<QWidget*>(tabs), static_cast<QWidget*>(table)})
        layout->addWidget(each);
    window.resize(600, 300);
    window.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&window));
    EXPECT_EQ(cutTexts(window).join('\n').toStdString(), "");
    const auto cuts = [&](const char* text) { return cutTexts(window).join('\n').contains(text); };
    box->setFixedWidth(60);
    letLive(20);
    EXPECT_TRUE(cuts("a choice of several words"));
    tabs->setFixedWidth(160);
    letLive(20);
    EXPECT_TRUE(cuts("The second of them"));
    table->horizontalHeader()->resizeSection(1, 30);
    EXPECT_TRUE(cuts("Uncertainty"));
    EXPECT_FALSE(cuts("Quantity"));
}

TEST_P(InTheme, TextHasAContrastOfFourAndAHalf) {
    const auto& c = gui::colours();
    for (const auto& words : {c.text, c.quiet, c.amberText, c.fault, c.passText, c.currentText})
        EXPECT_GE(contrast(words, c.base), 4.5) << words.name().toStdString();
    // Colours used in cells: near and beyond the limit, within the limit, and selected rows.
    const std::pair<QColor, QColor> cells[] = {
        {c.text, c.passCell}, {c.passText, c.passCell}, {c.text, c.amberCell}, {c.amberText, c.amberCell},
        {c.failText, c.fail}, {c.amberInk, c.amber},    {c.text, c.selection}};
    for (const auto& [ink, paper] : cells)
        EXPECT_GE(contrast(ink, paper), 4.5) << ink.name().toStdString() << " on " << paper.name().toStdString();
    const auto palette = QApplication::palette();
    using P = QPalette;
    const std::pair<P::ColorRole, P::ColorRole> pairs[] = {
        {P::WindowText, P::Window},         {P::PlaceholderText, P::Window},  {P::Text, P::Base},
        {P::Text, P::AlternateBase},        {P::PlaceholderText, P::Base},    {P::ButtonText, P::Button},
        {P::HighlightedText, P::Highlight}, {P::ToolTipText, P::ToolTipBase}, {P::Link, P::Base}};
    for (const auto& [ink, paper] : pairs)
        EXPECT_GE(contrast(palette.color(ink), palette.color(paper)), 4.5) << int(ink) << " on " << int(paper);
    for (int state = 0; state <= int(InterlockState::Faulted); ++state) {
        const auto style = gui::stateStyle(InterlockState(state));
        EXPECT_GE(contrast(style.ink, style.ground), 4.5) << style.word.toStdString();
    }
}

/// Returns the share of the pixels with a contrast of at least 3:1 to the colour at `at`.
double shareSeenOn(QWidget& widget, const QPoint& at) {
    const auto picture = widget.grab().toImage();
    const auto ground = picture.pixelColor(at);
    int seen = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) seen += contrast(picture.pixelColor(x, y), ground) >= 3;
    return double(seen) / (picture.width() * picture.height());
}

TEST_P(InTheme, TheWordsOfAProgressBarAreReadOnBothItsGrounds) {
    gui::ProgressBar bar;
    bar.setRange(0, 2);
    bar.setFormat("Interval: 74 of 110");
    bar.resize(220, bar.sizeHint().height());
    bar.show();
    const auto& c = gui::colours();
    EXPECT_GE(contrast(c.text, c.sunken), 4.5);
    EXPECT_GE(contrast(c.base, c.bar), 4.5);
    const auto drawn = [&](int value) {
        bar.setValue(value);
        QCoreApplication::processEvents();
        return bar.grab().toImage();
    };
    const auto empty = drawn(0), half = drawn(1), whole = drawn(2);
    EXPECT_GT(pixelsOf(empty, c.text), 30);
    EXPECT_EQ(pixelsOf(whole, c.text), 0) << "nothing is written in it on the fill";
    EXPECT_GT(pixelsOf(whole, c.base), 30);
    EXPECT_GT(pixelsOf(half, c.text), 10);
    EXPECT_GT(pixelsOf(half, c.base), 10);
}

TEST_P(InTheme, TheTickOfACheckBoxIsSeen) {
    QCheckBox box;
    box.resize(20, 20);
    box.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&box));
    box.setChecked(true);
    const auto picture = box.grab().toImage();
    int ticked = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < 14; ++x)
            ticked += contrast(picture.pixelColor(x, y), gui::colours().primary) >= 3 &&
                      contrast(picture.pixelColor(x, y), gui::colours().primaryText) < 1.5;
    EXPECT_GE(ticked, 10);
    EXPECT_GT(pixelsOf(picture, gui::colours().primary), 60) << "its ground";
}

TEST_P(InTheme, AnIconIsSeenOnAPrimaryButtonAlsoWhileItsPageYields) {
    QWidget page;
    auto* row = new QHBoxLayout(&page);
    auto* button = new QPushButton("Run", &page);
    button->setIcon(gui::icon("run", gui::Ink::Primary));
    gui::makePrimary(*button);
    row->addWidget(button);
    page.resize(200, 60);
    for (const bool yields : {false, true, false}) {
        gui::letYield(page, yields);
        const auto ground = button->grab().toImage().pixelColor(6, button->height() / 2);
        const auto drawn = button->icon().pixmap(24).toImage();
        double most = 0;
        for (int y = 0; y < drawn.height(); ++y)
            for (int x = 0; x < drawn.width(); ++x)
                if (const auto ink = drawn.pixelColor(x, y); ink.alpha() > 200)
                    most = std::max(most, contrast(ink, ground));
        EXPECT_GE(most, 4.5) << "yields: " << yields;
    }
}

TEST_P(InTheme, EdgesOfFieldsAreSeen) {
    for (const auto& ground : {gui::colours().base, gui::colours().window})
        EXPECT_GE(contrast(gui::colours().edge, ground), 3) << ground.name().toStdString();
    QWidget window;
    auto* layout = new QVBoxLayout(&window);
    auto* line = new QLineEdit(&window);
    auto* box = new QComboBox(&window);
    auto* spin = new QSpinBox(&window);
    auto* tick = new QCheckBox(&window);
    for (QWidget* each : {static_cast<QWidget*>(line), static_cast<QWidget*>(box), static_cast<QWidget*>(spin),
                          static_cast<QWidget*>(tick)})
        layout->addWidget(each);
    window.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&window));
    window.setFocus();
    for (QWidget* each : {static_cast<QWidget*>(line), static_cast<QWidget*>(box), static_cast<QWidget*>(spin)}) {
        const auto picture = each->grab().toImage();
        const auto edge = picture.pixelColor(0, picture.height() / 2);
        EXPECT_GE(contrast(edge, picture.pixelColor(4, picture.height() / 2)), 3) << each->metaObject()->className();
    }
    EXPECT_GT(shareSeenOn(*tick, {7, tick->height() / 2}), 0.01) << "an empty box";
}

TEST_P(InTheme, RedIsForStopAndFaultsAndNothingElse) {
    const auto& c = gui::colours();
    EXPECT_TRUE(isRed(c.fault));
    for (const auto& other :
         {c.window,     c.base,    c.sunken,   c.selection, c.line, c.edge,  c.text,  c.quiet,     c.primary,
          c.voltage,    c.current, c.third,    c.grid,      c.zero, c.frame, c.amber, c.amberText, c.amberCell,
          c.delivering, c.pass,    c.passText, c.passCell,  c.fail, c.hatch, c.bar})
        EXPECT_FALSE(isRed(other)) << other.name().toStdString();
    for (int state = 0; state < int(InterlockState::Faulted); ++state) {
        const auto style = gui::stateStyle(InterlockState(state));
        EXPECT_FALSE(isRed(style.ground) || isRed(style.ink)) << style.word.toStdString();
    }
    EXPECT_TRUE(isRed(gui::stateStyle(InterlockState::Faulted).ground));
    for (int index = 0; index < 8; ++index) EXPECT_FALSE(isRed(gui::conditionInTheme({}, index).color)) << index;
    for (const auto* name : {"smooth-low", "smooth-high", "rough-low", "rough-high"})
        EXPECT_FALSE(isRed(gui::conditionInTheme(name).color)) << name;
}

TEST(Icons, EachThatTheWindowNamesIsThere) {
    const QRegularExpression named(R"re(\bicon(?:Pixmap)?\("([a-z0-9-]+)")re");
    int found = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(sourceDir() / "app" / "gui")) {
        if (entry.path().extension() != ".cpp") continue;
        QFile file(QString::fromStdString(entry.path().string()));
        ASSERT_TRUE(file.open(QIODevice::ReadOnly));
        auto all = named.globalMatch(QString::fromUtf8(file.readAll()));
        while (all.hasNext()) {
            const auto name = all.next().captured(1);
            EXPECT_FALSE(gui::icon(name).isNull()) << entry.path().filename() << ": " << name.toStdString();
            ++found;
        }
    }
    EXPECT_GE(found, 15);
    EXPECT_TRUE(gui::icon("no-such-icon").isNull());
}

TEST(Mnemonics, AreUnderlinedOnlyWhileAltIsHeld) {
    gui::applyTheme(Theme::Light);
    QPushButton button("&Press");
    button.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&button));
    const auto plain = button.grab().toImage();
    QTest::keyPress(&button, Qt::Key_Alt);
    EXPECT_NE(button.grab().toImage(), plain);
    QTest::keyRelease(&button, Qt::Key_Alt);
    EXPECT_EQ(button.grab().toImage(), plain);
}

TEST(ElidedLabel, ShowsNothingWhereAFewLettersAloneHaveRoom) {
    gui::ElidedLabel label("Exposure within limits");
    const auto wide = label.fontMetrics().horizontalAdvance(label.text());
    label.resize(wide + 2, 20);
    EXPECT_EQ(label.shownText(), label.text());
    label.resize(wide / 2, 20);
    EXPECT_TRUE(label.shownText().startsWith("Exp") && label.shownText().endsWith("…"))
        << label.shownText().toStdString();
    for (const int width : {0, 6, 14, 24}) {
        label.resize(width, 20);
        EXPECT_EQ(label.shownText(), "") << width << " px";
    }
    label.setText("12");
    label.resize(30, 20);
    EXPECT_EQ(label.shownText(), "12") << "a short text is whole";
}

/// A screen reader counts the children and then asks for one; between the two a scroll bar may have been hidden.
TEST(Pages, AScreenReaderThatAsksForAScrollBarThatIsGoneGetsNone) {
    RecordProperty("hazard", "H10");
    gui::ScrollingPage page(nullptr);
    QScrollArea plain;
    for (QScrollArea* area : {static_cast<QScrollArea*>(&page), &plain}) {
        auto* seen = QAccessible::queryAccessibleInterface(area);
        ASSERT_NE(seen, nullptr);
        ASSERT_GE(seen->childCount(), 1);
        EXPECT_EQ(seen->child(0)->object(), area->viewport());
        for (const int index : {-1, seen->childCount(), seen->childCount() + 100})
            EXPECT_EQ(seen->child(index), nullptr) << index;
    }
}

}  // namespace
}  // namespace tacto::test
