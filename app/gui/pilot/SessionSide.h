// SessionSide.h - what stands beside a session: who takes part, what their screen shows, and the stops.
#pragma once

#include <QFrame>
#include <QGridLayout>
#include <QLabel>
#include <QScrollArea>
#include <QWidget>
#include <vector>

namespace tacto::gui {

class FactsCard;
class SessionConduct;
class TheirScreen;

class SessionSide final : public QScrollArea {
    Q_OBJECT
public:
    explicit SessionSide(QWidget* parent = nullptr);
    void show(const SessionConduct& session);
    using QWidget::show;

private:
    FactsCard* who_;
    FactsCard* screen_;
    TheirScreen* theirs_;
    FactsCard* stops_;
};

/// Facts beside each other: a title with its icon, and rows of a name and a value.
class FactsCard final : public QFrame {
    Q_OBJECT
public:
    struct Fact {
        QString name, value;
        bool strong = false;
        bool operator==(const Fact&) const = default;
    };
    FactsCard(const QString& title, const QString& iconName, QWidget* parent = nullptr);
    void setFacts(const std::vector<Fact>& facts);
    /// Below the title, in place of rows or above them. Takes the widget.
    void setPicture(QWidget* picture);
    void setWords(const QString& words);

private:
    void dress();
    QString icon_;
    QLabel* picture_;
    QVBoxLayout* column_;
    QGridLayout* grid_;
    QLabel* words_ = nullptr;
    std::vector<Fact> facts_;
};

/// A small picture of the participant's screen at this moment: where targets are, or the dot. The same drawing for
/// every condition.
class TheirScreen final : public QWidget {
    Q_OBJECT
public:
    enum class Shows { Nothing, Dot, Targets };
    explicit TheirScreen(QWidget* parent = nullptr);
    void setShows(Shows shows);
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return {1, sizeHint().height()}; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    Shows shows_ = Shows::Nothing;
};

}  // namespace tacto::gui
