#include "app/gui/window/WorkspaceRail.h"

#include <QToolButton>
#include <algorithm>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kRailIcon = 24, kMaxRailIcon = 40;
constexpr double kIconsAloneFrom_pt = 15;  // with larger text the words would take the room of the data

}  // namespace

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
        auto* action = addAction(icon(iconName), name);
        action->setCheckable(true);
        action->setShortcut(QKeySequence(Qt::CTRL | static_cast<Qt::Key>(Qt::Key_1 + index)));
        action->setToolTip(tr("%1 (%2)").arg(tip, action->shortcut().toString(QKeySequence::NativeText)));
        workspaces_->addAction(action);
        connect(action, &QAction::triggered, this, [this, index] { emit chosen(index); });
        auto* button = qobject_cast<QToolButton*>(widgetForAction(action));
        nameWidget(*button, "workspaceButton", name);
        button->setFocusPolicy(Qt::TabFocus);
        button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        setTextSize(*button, TextSize::Small);
        parentWidget()->addAction(action);  // so that its key works wherever the focus is
        ++index;
    }
    fit();
    onFontChange(*this, [this] { fit(); });
}

void WorkspaceRail::fit() {
    const int side = std::min(scaledPx(kRailIcon), kMaxRailIcon);
    setIconSize({side, side});
    const bool words = font().pointSizeF() <= kIconsAloneFrom_pt;
    setToolButtonStyle(words ? Qt::ToolButtonTextUnderIcon : Qt::ToolButtonIconOnly);
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

}  // namespace tacto::gui

#include "moc_WorkspaceRail.cpp"
