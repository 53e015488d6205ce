// WorkspaceRail.h - the bar at the left of the window: one button for each workspace, with keys Ctrl+1 to Ctrl+7.
#pragma once

#include <QActionGroup>
#include <QToolBar>
#include <optional>

namespace tacto::gui {

class WorkspaceRail final : public QToolBar {
    Q_OBJECT
public:
    explicit WorkspaceRail(QWidget* parent);
    /// One action per workspace, in the order of the pages; a menu may contain them too.
    [[nodiscard]] const QActionGroup& workspaces() const noexcept { return *workspaces_; }
    void setCurrent(int index);
    /// Disables all workspaces but one, or all; tool tips give the reason.
    void keepTo(std::optional<int> index, const QString& reason);

signals:
    /// The user chose a workspace by click, key or menu.
    void chosen(int index);

private:
    void fit();
    QActionGroup* workspaces_;
};

}  // namespace tacto::gui
