#include "app/gui/scope/panels/ScopeTools.h"

#include <QActionGroup>
#include <QMenu>
#include <algorithm>
#include <cmath>

#include "app/gui/scope/model/Viewport.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/ToolRow.h"

namespace tacto::gui {

namespace {

struct ToolWords {
    ScopeTool tool;
    const char* name;
    const char* tip;
    const char* icon;
    bool checkable = true;
};

#define WORDS(text) QT_TRANSLATE_NOOP("tacto::gui::ScopeTools", text)

constexpr ToolWords kViews[] = {
    {ScopeTool::Fit, WORDS("Fit"),
     WORDS("Home or a double click: the pulse in a third of the screen, every lane as large as it can be; once more: "
           "the whole record."),
     "fit", false},
    {ScopeTool::Undo, WORDS("Undo zoom"), WORDS("Ctrl+Z: back to the view before."), "undo-zoom", false},
    {ScopeTool::Box, WORDS("Box"),
     WORDS("B: the next drag draws a box that becomes the whole screen. Shift+drag does it at once."), "box-zoom"},
    {ScopeTool::TimeCursors, WORDS("Time cursors"),
     WORDS("T: two cursors across time. They snap to edges; arrows nudge the one with the dark flag, Ctrl+arrow jumps "
           "to the next edge, 1 and 2 choose."),
     "time-cursors"},
    {ScopeTool::LevelCursors, WORDS("Level cursors"),
     WORDS("L: two cursors across the active lane's level. They snap to where the signal rests; up and down nudge, 3 "
           "and 4 choose."),
     "level-cursors"}};
constexpr ToolWords kPanels[] = {
    {ScopeTool::Average, WORDS("Average"),
     WORDS("The mean of the latest captures, aligned at the trigger. Set their number in the controls."), "average"},
    {ScopeTool::Mask, WORDS("Mask"),
     WORDS("Tests captures against a band around what is shown now. Set its width in the controls. This does not "
           "affect the output."),
     "mask"},
    {ScopeTool::Spectrum, WORDS("Spectrum tool"), WORDS("The spectrum of what a lane shows on the screen, below it."),
     "spectrum"},
    {ScopeTool::Table, WORDS("All measurements"),
     WORDS("The chosen measurements of every channel with their statistics, below the screen."), "measurements"},
    {ScopeTool::Mark, WORDS("Mark"), WORDS("Ctrl+M: marks this moment with a word, in the record and in every plot."),
     "mark", false}};
constexpr ToolWords kControls{ScopeTool::Controls, WORDS("Controls"),
                              WORDS("Lanes, view, mask, trigger and record, in a column at the right."), "settings"};

#undef WORDS

/// A button that opens its menu wherever it is clicked; the arrow has its own space.
QToolButton* menuTool(const QString& text, const QString& tip, QWidget* parent) {
    auto* button = makeTool(text, tip, {}, parent);
    button->setText(text);
    button->setPopupMode(QToolButton::MenuButtonPopup);
    button->setMenu(new QMenu(button));
    button->menu()->setToolTipsVisible(true);
    QObject::connect(button, &QToolButton::clicked, button, &QToolButton::showMenu);
    return button;
}

}  // namespace

ScopeTools::ScopeTools(QMenu* files, QWidget* parent)
    : QWidget(parent), run_(new QPushButton(tr("Run"), this)), modes_(new QActionGroup(this)) {
    auto* row = new ToolRow(this);
    const auto add = [&](const ToolWords& its) {
        auto* button = makeTool(tr(its.name), tr(its.tip), its.icon, this);
        button->setText(tr(its.name));
        button->setToolButtonStyle(Qt::ToolButtonIconOnly);
        button->setCheckable(its.checkable);
        row->addWidget(tools_[its.tool] = button);
    };
    run_->setToolTip(tr("R: Run takes captures; Hold keeps the picture. Neither touches the output: STOP does."));
    makePrimary(*run_);
    row->addWidget(run_);
    addModes(*row);
    std::ranges::for_each(kViews, add);
    row->addGap();
    std::ranges::for_each(kPanels, add);
    row->addGap();
    pictures_ = new PictureTools(this);
    auto& save = pictures_->save();
    save.setAccessibleName(tr("Save"));
    save.setToolTip(tr("Copies and saves the picture and its data, opens captures. Ctrl+S saves."));
    save.setPopupMode(QToolButton::InstantPopup);
    save.setMenu(files);
    row->addWidget(&save);
    row->addWidget(&pictures_->copy());
    add(kControls);
    row->addWidget(&pictures_->plotOnly());
    pictures_->plotOnly().raise();  // last in the tab order, which follows the order of the widgets (TabbedPage.h)
    // Shows only icon and tip if the word would push other tools out of the row.
    onEvent(*this, QEvent::Resize, [this] {
        const bool worded = single_->toolButtonStyle() == Qt::ToolButtonTextBesideIcon;
        const int word = fontMetrics().horizontalAdvance(single_->text()) + 2 * fontMetrics().averageCharWidth();
        const bool room = width() >= layout()->sizeHint().width() + (worded ? 0 : word);
        if (room == worded) return;
        single_->setToolButtonStyle(room ? Qt::ToolButtonTextBesideIcon : Qt::ToolButtonIconOnly);
        style()->polish(single_);  // the text size may have changed while the icon stood alone
    });
}

void ScopeTools::addModes(ToolRow& row) {
    single_ = makeTool(tr("Single"), tr("S: takes one capture and holds it."), "single", this);
    single_->setText(tr("Single"));
    single_->setCheckable(true);
    single_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    connect(single_, &QToolButton::clicked, this, [this] { emit modeChosen(ScopeMode::Single); });
    mode_ = menuTool(tr("Auto"), tr("What makes a capture."), this);
    const auto add = [&](ScopeMode mode, const QString& text, const QString& tip) {
        auto* action = mode_->menu()->addAction(text, this, [this, mode] { emit modeChosen(mode); });
        action->setToolTip(tip);
        action->setCheckable(true);
        action->setData(static_cast<int>(mode));
        modes_->addAction(action);
    };
    add(ScopeMode::Auto, tr("Auto"),
        tr("A: the trigger level follows a fifth of the commanded amplitude. When no trigger comes, the signal is "
           "shown untriggered."));
    add(ScopeMode::Normal, tr("Normal"), tr("N: captures whenever the signal rises through the level set here."));
    add(ScopeMode::Roll, tr("Roll"),
        tr("Captures one after the other on the session's time. A capture is a record around a trigger: what lies "
           "between them was not recorded and is hatched."));
    base_ = menuTool(tr("Time base"), tr("How much time one of the ten divisions is."), this);
    bases_ = new QActionGroup(base_);
    bases_->setExclusionPolicy(QActionGroup::ExclusionPolicy::ExclusiveOptional);  // the present base may not be listed
    connect(base_->menu(), &QMenu::aboutToShow, this, &ScopeTools::markTimeBase);
    for (const double step : stepsBetween(100e-9, 1)) {
        auto* action = base_->menu()->addAction(tr("%1/div").arg(settingText(step, "s")), this,
                                                [this, step] { emit timeBaseChosen(step); });
        action->setCheckable(true);
        action->setData(step);
        bases_->addAction(action);
    }
    for (auto* button : {single_, mode_, base_}) row.addWidget(button);
}

void ScopeTools::showMode(ScopeMode mode) {
    single_->setChecked(mode == ScopeMode::Single);
    for (auto* action : modes_->actions()) {
        if (action->data().toInt() != static_cast<int>(mode)) continue;
        action->setChecked(true);
        mode_->setText(action->text());
    }
}

void ScopeTools::showRunning(bool running, bool possible) {
    run_->setText(running ? tr("Hold") : tr("Run"));
    run_->setIcon(icon(running ? "hold" : "run", Ink::Primary));
    run_->setEnabled(possible);
}

void ScopeTools::showTimeBase(double perDivision_s, double least_s) {
    base_s_ = stepNotBelow(perDivision_s);
    leastBase_s_ = least_s;
    markTimeBase();
    // The step between two grid lines, which lie at round numbers.
    base_->setText(tr("%1/div").arg(settingText(base_s_, "s")));
    base_->setAccessibleName(tr("Time base tool"));
    base_->setMinimumWidth(base_->fontMetrics().horizontalAdvance("000 µs/div") + scaledPx(24));
}

void ScopeTools::markTimeBase() {
    constexpr double kSameBase = 1e-6;  // relative difference up to which two values are equal
    for (auto* action : bases_->actions()) {
        const double step_s = action->data().toDouble();
        action->setChecked(std::abs(step_s - base_s_) < kSameBase * base_s_);
        action->setEnabled(step_s > leastBase_s_ * (1 - kSameBase));
    }
}

}  // namespace tacto::gui

#include "moc_ScopeTools.cpp"
