// The oscilloscope's row of tools above the screen.
#include <QButtonGroup>
#include <QMenu>
#include <QPushButton>
#include <QToolButton>

#include "app/gui/scope/ScopeView.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/scope/ToolRow.h"

namespace tacto::gui {

QToolButton* ScopeWorkspace::tool(const QString& text, const QString& tip, bool checkable) {
    auto* button = new QToolButton(this);
    button->setText(text);
    button->setToolTip(tip);
    button->setCheckable(checkable);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::StrongFocus);
    return button;
}

QWidget* ScopeWorkspace::buildTools() {
    auto* bar = new QWidget(this);
    auto* row = new ToolRow(bar);
    run_ = new QPushButton(tr("Run"), this);
    run_->setToolTip(tr("Run takes captures; Hold keeps the picture. Neither touches the output: STOP does."));
    connect(run_, &QPushButton::clicked, this, [this] { running_ ? hold() : run(); });
    row->addWidget(run_);
    modes_ = new QButtonGroup(this);
    const auto mode = [&](ScopeMode which, const QString& text, const QString& tip) {
        auto* button = tool(text, tip, true);
        modes_->addButton(button, static_cast<int>(which));
        button->setChecked(which == mode_);
        connect(button, &QToolButton::clicked, this, [this, which] { setMode(which); });
        row->addWidget(button);
    };
    mode(ScopeMode::Auto, tr("Auto"),
         tr("A: the trigger level follows a fifth of the commanded amplitude. When no trigger comes, the signal "
            "is shown untriggered."));
    mode(ScopeMode::Normal, tr("Normal"), tr("N: captures whenever the signal rises through the level set here."));
    mode(ScopeMode::Single, tr("Single"), tr("S: takes one capture and holds it."));
    mode(ScopeMode::Roll, tr("Roll"),
         tr("Captures one after the other on the session's time. A capture is a record "
            "around a trigger: what lies between them was not recorded and is hatched."));
    row->addGap();
    auto* fit =
        tool(tr("Fit"), tr("Home or a double click: the whole record, every lane as large as it can be."), false);
    connect(fit, &QToolButton::clicked, this, [this] { view_->fit(); });
    undo_ = tool(tr("Undo zoom"), tr("Ctrl+Z: back to the view before."), false);
    connect(undo_, &QToolButton::clicked, this, [this] { view_->undoZoom(); });
    box_ = tool(tr("Box"), tr("The next drag draws a box that becomes the whole screen. Shift+drag does it at once."),
                true);
    connect(box_, &QToolButton::toggled, this, [this](bool on) { view_->setBoxZoom(on); });
    timeCursors_ = tool(tr("Time cursors"),
                        tr("Two cursors across time. They snap to edges; arrows nudge the one with "
                           "the filled tag, Ctrl+arrow jumps to the next edge, 1 and 2 choose."),
                        true);
    connect(timeCursors_, &QToolButton::toggled, this, [this](bool on) { view_->setTimeCursors(on); });
    levelCursors_ = tool(tr("Level cursors"),
                         tr("Two cursors across the active lane's level. They snap to where the "
                            "signal rests; up and down nudge, 3 and 4 choose."),
                         true);
    connect(levelCursors_, &QToolButton::toggled, this, [this](bool on) { view_->setLevelCursors(on); });
    for (auto* button : {fit, undo_, box_, timeCursors_, levelCursors_}) row->addWidget(button);
    row->addGap();
    auto* save = tool(tr("Save"), tr("Copies and saves the picture and its data, opens captures."), false);
    save->setPopupMode(QToolButton::InstantPopup);
    save->setMenu(menu_);
    row->addWidget(save);
    controlsShown_ =
        tool(tr("Controls"), tr("Shows or hides the column at the right, to give the screen its room."), true);
    controlsShown_->setChecked(true);
    row->addWidget(controlsShown_);
    cancelOpen_ = tool(tr("Cancel"), tr("Gives up reading. What is shown stays."), false);
    connect(cancelOpen_, &QToolButton::clicked, &pipe_, &CapturePipe::cancelOpen);
    return bar;
}

}  // namespace tacto::gui
