// SessionSide.h - the column next to a session's page: who takes part, the participant's screen, and the stops.
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

/// A card of facts: a title with an icon, and rows of a name and a value.
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
    /// Shows a picture below the title, above the rows if there are any. Takes ownership of the widget.
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

/// A small picture of the participant's screen at this moment: the places of the targets, or the dot. It is the same
/// for every condition.
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
