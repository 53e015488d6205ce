// ProtocolHead.h - which protocol this is: its title and purpose, the way to its script, and a chooser where the
// operator chooses among all of them. In a row it has one line, without the purpose.
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
    /// Lists every protocol, shipped and the lab's own, and chooses `select`, else the first: chosen() follows. Returns
    /// whether there is any.
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
    QLabel* line_;  ///< the title, where there is one line for it
    QHBoxLayout* buttons_;
    bool across_ = false;
};

}  // namespace tacto::gui
