// WorkspaceRail.h - the workspaces at the left of the window, one button each with its key, Ctrl+1 to Ctrl+7.
#pragma once

#include <QActionGroup>
#include <QToolBar>
#include <optional>

namespace tacto::gui {

class WorkspaceRail final : public QToolBar {
    Q_OBJECT
public:
    explicit WorkspaceRail(QWidget* parent);
    /// One action each, in the order of the window's pages; a menu may hold them too.
    [[nodiscard]] const QActionGroup& workspaces() const noexcept { return *workspaces_; }
    void setCurrent(int index);
    /// Puts all workspaces but one, or all, out of reach, for a reason that their tool tips give.
    void keepTo(std::optional<int> index, const QString& reason);

signals:
    /// chosen by click, key or menu
    void chosen(int index);

private:
    void fit();
    QActionGroup* workspaces_;
};

}  // namespace tacto::gui
