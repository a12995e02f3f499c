#pragma once
#include "contact/law/contact_term.hpp"
#include "core/mesh/distributed/halo.hpp"

namespace bulbus::inline contact {

/// What a contact of nodes cannot feel: a master with corners, or a body, finer than the slave's faces, which
/// enters between the nodes. The middles of the faces are followed as points of a contact without forces. A
/// converged state is refused in which one lies deeper inside than the nodes do by more than a part of its
/// face's width h: h/4, the chord height of a body as curved as the face is wide; at the end of a step h/10
/// where no corner of the face is in contact, so that nothing keeps the face out. On the way there a ball may
/// touch the middle of a face first.
class MidfaceCheck final : public Term {
 public:
  /// `spec`: of the contact that `nodes` is.
  MidfaceCheck(const ContactSpec& spec, const ContactDefaults& defaults, const ContactSides& sides,
               const Comm& comm, const Halo& halo, std::shared_ptr<const ContactTerm> nodes);

  void add_residual(const State& state, std::span<double>, std::span<double>) const override {
    middles_.rests(state);
  }
  void begin_step(int step, const State& state) override { middles_.begin_step(step, state); }
  void pass_step(int step, const State& start) override { middles_.pass_step(step, start); }
  void set_progress(double s) override { progress_ = s, middles_.set_progress(s); }
  void freeze() override { middles_.freeze(); }
  void commit(const State& state) override { middles_.commit(state); }
  void roll_back() override { middles_.roll_back(); }
  void serialize(Archive& archive) override { middles_.serialize(archive); }
  std::string refusal(const State& state) const override;
  /// As the contact's own: its overlap at the start is made good over the first step.
  void resolve(const State& start) { middles_.resolve(start); }

  int points() const { return middles_.points().size(); }

 private:
  Overlap entered(const State& state) const;

  ContactSpec spec_;
  double progress_ = 0;
  Comm comm_;
  Halo halo_;
  bool rigid_;
  std::shared_ptr<const ContactTerm> nodes_;
  ContactTerm middles_;
};

}  // namespace bulbus::inline contact
