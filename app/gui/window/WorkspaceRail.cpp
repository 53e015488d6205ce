#include "app/gui/window/WorkspaceRail.h"

#include "app/gui/window/RailButton.h"

namespace tacto::gui {

WorkspaceRail::WorkspaceRail(QWidget* parent)
    : QToolBar(tr("Workspaces"), parent), workspaces_(new QActionGroup(this)) {
    setObjectName("workspaces");
    setMovable(false);
    setFloatable(false);
    toggleViewAction()->setEnabled(false);
    setContextMenuPolicy(Qt::PreventContextMenu);
    struct Entry {
        QString name, icon, tip;
    };
    const Entry entries[] = {
        {tr("Live"), "live", tr("Touch, drive by hand, replay, and the oscilloscope")},
        {tr("Calibrate"), "calibrate", tr("What the stimulator really delivers, and until when that holds")},
        {tr("Safety check"), "safety-check", tr("Limits on resistor loads")},
        {tr("Separability"), "separability", tr("Can an oscilloscope tell the four conditions apart?")},
        {tr("Pilot"), "pilot", tr("Sessions with volunteers")},
        {tr("Sessions"), "sessions", tr("Everything that was recorded")},
        {tr("Protocols"), "protocols", tr("Every protocol script, shipped and the lab's own")},
    };
    int index = 0;
    for (const auto& [name, iconName, tip] : entries) {
        auto* action = new QAction(name, this);
        action->setCheckable(true);
        action->setShortcut(QKeySequence(Qt::CTRL | static_cast<Qt::Key>(Qt::Key_1 + index)));
        action->setToolTip(tr("%1 (%2)").arg(tip, action->shortcut().toString(QKeySequence::NativeText)));
        workspaces_->addAction(action);
        connect(action, &QAction::triggered, this, [this, index] { emit chosen(index); });
        addWidget(new RailButton(action, iconName, this));
        parentWidget()->addAction(action);  // its key, wherever the focus is
        ++index;
    }
}

void WorkspaceRail::setCurrent(int index) { workspaces_->actions().at(index)->setChecked(true); }

void WorkspaceRail::keepTo(std::optional<int> index, const QString& reason) {
    const auto actions = workspaces_->actions();
    for (int i = 0; i < actions.size(); ++i) {
        auto* action = actions.at(i);
        const bool allowed = !index || i == *index;
        if (!allowed && action->isEnabled()) action->setData(action->toolTip());
        if (allowed && !action->isEnabled()) action->setToolTip(action->data().toString());
        if (!allowed) action->setToolTip(reason);
        action->setEnabled(allowed);
    }
}

void WorkspaceRail::fit() {
    for (auto* button : findChildren<RailButton*>()) button->updateGeometry();
}

}  // namespace tacto::gui

#include "moc_WorkspaceRail.cpp"
