// DockColumn.h - the column of docks at the right: open, or collapsed to a strip with names and key figures.
//
// The column's state is kept for each workspace: live work starts with open docks, all other pages leave the room to
// their plot. A floating dock never covers the safety bar.
#pragma once

#include <QAction>
#include <QMainWindow>
#include <QToolBar>
#include <set>
#include <vector>

#include "app/gui/theme/Theme.h"
#include "app/gui/window/FoldingDock.h"

namespace tacto::gui {

class StripButton;

class DockColumn final : public QObject {
    Q_OBJECT
public:
    /// The window owns the docks. They are listed from top to bottom.
    DockColumn(QMainWindow& window, std::vector<FoldingDock*> docks);
    /// The page next to the docks, and the state of the docks when the page is first shown.
    struct View {
        int workspace = 0;
        QString name;  ///< a workspace can have several views
        bool open = false;
        std::vector<FoldingDock*> folded;
    };
    /// Shows the docks as the user left them in this view, or at first as `view` says.
    void enter(const View& view);
    void setCollapsed(bool collapsed);
    [[nodiscard]] bool collapsed() const { return collapsed_; }
    [[nodiscard]] const std::vector<FoldingDock*>& docks() const { return docks_; }
    /// Opens the column and unfolds this dock; waits while the column is hidden.
    void show(FoldingDock& dock);
    /// Restores the first start: docks in their places, and open for live work.
    void reset();
    /// Reasons for hiding docks and strip, floating docks included. One reason is enough.
    enum class Hidden {
        PlotOnly,
        Blind,  ///< the operator is blind and must not see what is delivered
    };
    void setHidden(Hidden why, bool hidden);
    /// Updates the key figures; called as often as telemetry is read.
    void refresh();
    /// The action that collapses or opens the column; has a key.
    [[nodiscard]] QAction* toggle() const { return toggle_; }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void apply();
    void leaveBar(FoldingDock& dock);
    void fitStrip();
    void fitWidth();
    void foldAsLeft();
    void share();

    QMainWindow& window_;
    std::vector<FoldingDock*> docks_;
    std::vector<StripButton*> buttons_;
    QToolBar* strip_;
    QWidget* bar_ = nullptr;  // the window's safety bar
    QAction* toggle_;
    View view_;
    bool entering_ = false;  // true while enter() sets the folds, which are then not stored as the operator's choice
    bool collapsed_ = false;
    int width_ = scaledPx(FoldingDock::kWidth);  // the smallest width of the docks
    std::set<Hidden> hidden_;
    std::vector<FoldingDock*> putAway_;  // floating docks that are hidden for now
};

}  // namespace tacto::gui
