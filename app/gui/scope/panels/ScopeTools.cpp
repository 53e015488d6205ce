#include "app/gui/scope/panels/ScopeTools.h"

#include <QActionGroup>
#include <QMenu>
#include <QPushButton>
#include <QToolButton>
#include <cmath>

#include "app/gui/scope/model/Steps.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/ToolRow.h"

namespace tacto::gui {

namespace {

/// Anywhere on it; the arrow has a place of its own.
void opensMenu(QToolButton& button) {
    button.setPopupMode(QToolButton::MenuButtonPopup);
    QObject::connect(&button, &QToolButton::clicked, &button, &QToolButton::showMenu);
}

}  // namespace

ScopeTools::ScopeTools(QMenu* files, QWidget* parent)
    : QWidget(parent), run_(new QPushButton(tr("Run"), this)), modes_(new QActionGroup(this)) {
    auto* row = new ToolRow(this);
    run_->setToolTip(tr("R: Run takes captures; Hold keeps the picture. Neither touches the output: STOP does."));
    connect(run_, &QPushButton::clicked, this, &ScopeTools::runClicked);
    makePrimary(*run_);
    row->addWidget(run_);
    addModes(*row);
    addViews(*row);
    row->addGap();
    addPanels(*row);
    auto* mark =
        tool(tr("Mark"), tr("Ctrl+M: marks this moment with a word, in the record and in every plot."), false, "mark");
    connect(mark, &QToolButton::clicked, this, &ScopeTools::markClicked);
    row->addWidget(mark);
    row->addGap();
    pictures_ = new PictureTools(this);
    auto& save = pictures_->save();
    save.setAccessibleName(tr("Save"));
    save.setToolTip(tr("Copies and saves the picture and its data, opens captures. Ctrl+S saves."));
    save.setPopupMode(QToolButton::InstantPopup);
    save.setMenu(files);
    row->addWidget(&save);
    row->addWidget(&pictures_->copy());
    controls_ =
        tool(tr("Controls"), tr("Lanes, view, mask, trigger and record, in a column at the right."), true, "settings");
    connect(controls_, &QToolButton::clicked, this, &ScopeTools::controlsClicked);
    row->addWidget(controls_);
    row->addWidget(&pictures_->plotOnly());
    pictures_->plotOnly().raise();  // the last of them for Tab, which goes by this order (TabbedPage.h)
}

/// Its icon and its tip say it where a word would put other tools away.
void ScopeTools::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    const bool worded = single_->toolButtonStyle() == Qt::ToolButtonTextBesideIcon;
    const int word = fontMetrics().horizontalAdvance(single_->text()) + 2 * fontMetrics().averageCharWidth();
    const bool room = width() >= layout()->sizeHint().width() + (worded ? 0 : word);
    if (room != worded) single_->setToolButtonStyle(room ? Qt::ToolButtonTextBesideIcon : Qt::ToolButtonIconOnly);
}

void ScopeTools::addModes(ToolRow& row) {
    single_ = tool(tr("Single"), tr("S: takes one capture and holds it."), true, "single");
    single_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    connect(single_, &QToolButton::clicked, this, [this] { emit modeChosen(ScopeMode::Single); });
    row.addWidget(single_);
    mode_ = tool(tr("Auto"), tr("What makes a capture."), false);
    opensMenu(*mode_);
    auto* menu = new QMenu(mode_);
    menu->setToolTipsVisible(true);
    const auto add = [&](ScopeMode mode, const QString& text, const QString& tip) {
        auto* action = menu->addAction(text);
        action->setToolTip(tip);
        action->setCheckable(true);
        action->setData(static_cast<int>(mode));
        modes_->addAction(action);
        connect(action, &QAction::triggered, this, [this, mode] { emit modeChosen(mode); });
    };
    add(ScopeMode::Auto, tr("Auto"),
        tr("A: the trigger level follows a fifth of the commanded amplitude. When no trigger comes, the signal is "
           "shown untriggered."));
    add(ScopeMode::Normal, tr("Normal"), tr("N: captures whenever the signal rises through the level set here."));
    add(ScopeMode::Roll, tr("Roll"),
        tr("Captures one after the other on the session's time. A capture is a record around a trigger: what lies "
           "between them was not recorded and is hatched."));
    mode_->setMenu(menu);
    row.addWidget(mode_);
    base_ = tool(tr("Time base"), tr("How much time one of the ten divisions is."), false);
    opensMenu(*base_);
    auto* steps = new QMenu(base_);
    bases_ = new QActionGroup(base_);
    bases_->setExclusionPolicy(QActionGroup::ExclusionPolicy::ExclusiveOptional);  // a base may lie beyond the list
    connect(steps, &QMenu::aboutToShow, this, &ScopeTools::markTimeBase);
    for (const double step : stepsBetween(100e-9, 1)) {
        auto* action = steps->addAction(tr("%1/div").arg(settingText(step, "s")), this,
                                        [this, step] { emit timeBaseChosen(step); });
        action->setCheckable(true);
        action->setData(step);
        bases_->addAction(action);
    }
    base_->setMenu(steps);
    row.addWidget(base_);
}

void ScopeTools::addViews(ToolRow& row) {
    auto* fit = tool(tr("Fit"),
                     tr("Home or a double click: the pulse in a third of the screen, every lane as large as it can "
                        "be; once more: the whole record."),
                     false, "fit");
    connect(fit, &QToolButton::clicked, this, &ScopeTools::fitClicked);
    undo_ = tool(tr("Undo zoom"), tr("Ctrl+Z: back to the view before."), false, "undo-zoom");
    connect(undo_, &QToolButton::clicked, this, &ScopeTools::undoClicked);
    box_ =
        tool(tr("Box"), tr("B: the next drag draws a box that becomes the whole screen. Shift+drag does it at once."),
             true, "box-zoom");
    connect(box_, &QToolButton::toggled, this, &ScopeTools::boxToggled);
    time_ = tool(tr("Time cursors"),
                 tr("T: two cursors across time. They snap to edges; arrows nudge the one with the dark flag, "
                    "Ctrl+arrow jumps to the next edge, 1 and 2 choose."),
                 true, "time-cursors");
    connect(time_, &QToolButton::toggled, this, &ScopeTools::timeCursorsToggled);
    level_ = tool(tr("Level cursors"),
                  tr("L: two cursors across the active lane's level. They snap to where the signal rests; up and down "
                     "nudge, 3 and 4 choose."),
                  true, "level-cursors");
    connect(level_, &QToolButton::toggled, this, &ScopeTools::levelCursorsToggled);
    for (auto* button : {fit, undo_, box_, time_, level_}) row.addWidget(button);
}

void ScopeTools::addPanels(ToolRow& row) {
    average_ = tool(tr("Average"),
                    tr("The mean of the latest captures, aligned at the trigger. Set their number in the controls."),
                    true, "average");
    connect(average_, &QToolButton::clicked, this, &ScopeTools::averageClicked);
    mask_ = tool(tr("Mask"),
                 tr("Tests captures against a band around what is shown now. Set its width in the controls. This "
                    "does not affect the output."),
                 true, "mask");
    connect(mask_, &QToolButton::clicked, this, &ScopeTools::maskClicked);
    spectrum_ =
        tool(tr("Spectrum tool"), tr("The spectrum of what a lane shows on the screen, below it."), true, "spectrum");
    connect(spectrum_, &QToolButton::clicked, this, &ScopeTools::spectrumClicked);
    table_ = tool(tr("All measurements"),
                  tr("The chosen measurements of every channel with their statistics, below the screen."), true,
                  "measurements");
    connect(table_, &QToolButton::clicked, this, &ScopeTools::tableClicked);
    for (auto* button : {average_, mask_, spectrum_, table_}) row.addWidget(button);
}

QToolButton* ScopeTools::tool(const QString& text, const QString& tip, bool checkable, const QString& iconName) {
    auto* button = makeTool(text, tip, iconName, this);
    button->setText(text);
    if (!iconName.isEmpty()) button->setToolButtonStyle(Qt::ToolButtonIconOnly);
    button->setCheckable(checkable);
    return button;
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
    // What lies between two lines of the grid, which stand at round numbers.
    base_->setText(tr("%1/div").arg(settingText(base_s_, "s")));
    base_->setAccessibleName(tr("Time base tool"));
    base_->setMinimumWidth(base_->fontMetrics().horizontalAdvance("000 µs/div") + scaledPx(24));
}

void ScopeTools::markTimeBase() {
    constexpr double kSameBase = 1e-6;  // relative
    for (auto* action : bases_->actions()) {
        const double step_s = action->data().toDouble();
        action->setChecked(std::abs(step_s - base_s_) < kSameBase * base_s_);
        action->setEnabled(step_s > leastBase_s_ * (1 - kSameBase));
    }
}

void ScopeTools::showControls(bool on) { controls_->setChecked(on); }

void ScopeTools::showTable(bool on) { table_->setChecked(on); }

void ScopeTools::showSpectrum(bool on) { spectrum_->setChecked(on); }

void ScopeTools::showAverage(bool on) { average_->setChecked(on); }

void ScopeTools::showMask(bool on, bool possible) {
    mask_->setChecked(on);
    mask_->setEnabled(on || possible);
}

void ScopeTools::setCanUndo(bool can) { undo_->setEnabled(can); }

void ScopeTools::endBox() { box_->setChecked(false); }

void ScopeTools::toggleTimeCursors() { time_->toggle(); }

void ScopeTools::toggleLevelCursors() { level_->toggle(); }

void ScopeTools::toggleBox() { box_->toggle(); }

}  // namespace tacto::gui

#include "moc_ScopeTools.cpp"
