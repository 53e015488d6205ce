// FoldingDock.h - a dock with its own header: icon, title, and a button that folds the dock to its header; so does a
// click on the header. It can be moved and floats like any other dock.
#pragma once

#include <QDockWidget>
#include <QLabel>
#include <QToolButton>
#include <optional>
#include <vector>

namespace tacto::gui {

class FoldingDock : public QDockWidget {
    Q_OBJECT
public:
    static constexpr int kWidth = 231;  ///< least width at the normal text size, in pixels
    /// `name` is the object name under which the dock's place is saved.
    FoldingDock(const QString& title, const QString& iconName, const QString& name, QWidget* parent);
    /// The dock's share of the column. On a low screen every dock scrolls, so that the window does not get too large.
    enum class Room {
        Shared,
        First  ///< gets the height of its content as far as possible; the others share what is left
    };
    /// Sets the content, with the usual margin of docks around it.
    void setContent(QWidget* content, Room room = Room::Shared);
    [[nodiscard]] Room room() const { return room_; }
    /// The height at which the whole content is visible.
    [[nodiscard]] int wantedHeight() const;
    /// The heights at which a row of a list ends, so that none is cut; empty for content without rows.
    [[nodiscard]] virtual std::vector<int> rowEdges() const { return {}; }
    void fold(bool folded);
    [[nodiscard]] bool folded() const { return folded_; }
    [[nodiscard]] const QString& iconName() const { return icon_; }
    /// A figure that the collapsed dock still shows: "Off", "1.13 of 10 mA". May be empty.
    [[nodiscard]] virtual QString keyFigure() const { return {}; }

signals:
    void foldChanged();
    /// The wanted height has changed.
    void contentChanged();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    /// The height at which the content is visible from its top down to `y` of `part`.
    [[nodiscard]] int heightDownTo(const QWidget& part, int y) const;

private:
    [[nodiscard]] int heightBeside() const;
    void dress();
    void limitHeight();
    void noteContent();
    void makeRoomForBar(bool shown);
    void noteHeader(const QEvent& event);

    QString icon_;
    QWidget* header_;
    QLabel* picture_;
    QLabel* title_;
    QToolButton* toggle_;
    bool folded_ = false;
    Room room_ = Room::Shared;
    QWidget* inside_ = nullptr;  ///< the content of the scroll area, or content that scrolls by itself
    QWidget* bar_ = nullptr;     ///< the content's scroll bar
    int wanted_ = 0;
    std::optional<QPoint> pressed_;  ///< where on the screen the header was pressed and not yet released
};

}  // namespace tacto::gui
