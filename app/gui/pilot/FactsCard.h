// FactsCard.h - facts beside each other: a title with its icon, and rows of a name and a value.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QFrame>
#include <QGridLayout>
#include <QLabel>
#include <vector>

namespace tacto::gui {

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

}  // namespace tacto::gui
