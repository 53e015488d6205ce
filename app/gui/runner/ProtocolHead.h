// ProtocolHead.h - shows which protocol this is: title and purpose, a link to its script, and a chooser if the operator
// can choose any protocol. In a row it takes one line and leaves out the purpose.
#pragma once

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QWidget>

namespace tacto::gui {

class ProtocolHead final : public QWidget {
    Q_OBJECT
public:
    explicit ProtocolHead(bool chooses, QWidget* parent = nullptr);
    /// Lists all protocols, shipped and the lab's own, and chooses `select`, or else the first; chosen() is emitted.
    /// Returns false if there are no protocols.
    [[nodiscard]] bool fill(const QString& select);
    [[nodiscard]] bool chooses() const { return chooser_ != nullptr; }
    void setChangeable(bool changeable);
    void show(const QString& title, const QString& purpose);
    void setAcross(bool across);

signals:
    void chosen(const QString& nameOrPath);
    void editWanted();
    void newWanted();

private:
    void fitLine();
    void addButton(const QString& text, const QString& tip, void (ProtocolHead::*wanted)());
    QComboBox* chooser_ = nullptr;
    void showWords();
    QBoxLayout* layout_;
    QLabel* title_;
    QLabel* purpose_;
    QLabel* line_;  ///< the title, if it has one line
    QHBoxLayout* buttons_;
    bool across_ = false;
};

}  // namespace tacto::gui
