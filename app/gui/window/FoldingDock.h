// FoldingDock.h - a dock with a header of its own: icon, title, and a button that folds it to the header. It can be
// moved and floats as any other.
#pragma once

#include <QDockWidget>
#include <QLabel>
#include <QToolButton>

namespace tacto::gui {

class FoldingDock : public QDockWidget {
    Q_OBJECT
public:
    static constexpr int kWidth = 231;  ///< at least, at the usual size of text
    /// `name` is the object's, by which its place is remembered.
    FoldingDock(const QString& title, const QString& iconName, const QString& name, QWidget* parent);
    /// The dock's place in its column. On a low screen every dock scrolls, so that none makes the window too large.
    enum class Room {
        Shared,
        First  ///< gets the height of its content, as far as the others can give way; they take what is left
    };
    /// Takes `content`, with the docks' margin around it.
    void setContent(QWidget* content, Room room = Room::Shared);
    [[nodiscard]] Room room() const { return room_; }
    /// The height that shows all of its content.
    [[nodiscard]] int wantedHeight() const;
    void fold(bool folded);
    [[nodiscard]] bool folded() const { return folded_; }
    [[nodiscard]] const QString& iconName() const { return icon_; }
    /// The figure that a collapsed dock still shows: "Off", "1.13 of 10 mA". May be empty.
    [[nodiscard]] virtual QString keyFigure() const { return {}; }

signals:
    void foldChanged();
    /// The wanted height is another one.
    void contentChanged();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void dress();
    void limitHeight();
    void noteContent();
    void makeRoomForBar(bool shown);

    QString icon_;
    QWidget* header_;
    QLabel* picture_;
    QLabel* title_;
    QToolButton* toggle_;
    bool folded_ = false;
    Room room_ = Room::Shared;
    QWidget* inside_ = nullptr;  ///< the content of the scroll area, or the content that scrolls by itself
    QWidget* bar_ = nullptr;     ///< the scroll bar of the content
    int wanted_ = 0;
};

}  // namespace tacto::gui
