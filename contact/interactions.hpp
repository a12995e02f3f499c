#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "contact/law/contact_term.hpp"
#include "contact/law/midface_check.hpp"
#include "contact/rigid/rigid_motion.hpp"
#include "contact/suture/suture_term.hpp"
#include "core/problem/problem.hpp"

namespace bulbus::inline contact {

/// What a model says of rigid bodies, contacts and sutures, attached to its problem. Itself the first of
/// their terms, without forces: in each step it moves the bodies and hands the sutures their force.
class Interactions final : public Term {
 public:
  struct Contact {
    ContactSpec spec;
    std::shared_ptr<ContactTerm> term;
    std::shared_ptr<ContactTerm> exchanged;    ///< the other way, of a contact that goes both ways: the
                                               ///< master's nodes and the slave's faces
    std::shared_ptr<MidfaceCheck> middles;     ///< of a contact of nodes that goes one way
    std::shared_ptr<const RigidSurface> body;  ///< of a rigid master
    double penalty, thickness;                 ///< MPa/mm; thinner layer of the two, mm
    double farthest;  ///< fields have gaps up to here, a quarter of the model's diagonal, mm
  };

  /// Adds its terms to the problem; a model without any of the three has none. `base`: the mesh that was read
  /// or generated. Throws InputError. Collective.
  static std::shared_ptr<Interactions> attach(Problem& problem, const Mesh& base);

  const std::vector<Contact>& contacts() const { return contacts_; }
  const std::map<std::string, std::shared_ptr<SutureTerm>>& sutures() const { return sutures_; }
  const std::map<std::string, std::shared_ptr<RigidSurface>>& bodies() const { return bodies_; }
  RigidMotion& motion(const std::string& body) { return motions_.at(body); }
  /// Throw InputError with the key if there is none.
  const Contact& contact(const std::string& name, const std::string& key) const;
  const SutureTerm& suture(const std::string& name, const std::string& key) const;
  /// The contacts whose master is the rigid body; at least one.
  std::vector<const Contact*> contacts_on(const std::string& body, const std::string& key) const;
  /// Local nodes, ghosts included, in which the points of a suture hold the tissue.
  const std::vector<int>& bites(const std::string& suture) const { return bites_.at(suture); }
  /// Those points on the undeformed tissue, mm.
  const std::vector<Point>& suture_places(const std::string& suture) const {
    return suture_places_.at(suture);
  }

  void add_residual(const State&, std::span<double>, std::span<double>) const override {}
  void begin_step(int step, const State& start) override;
  void set_progress(double s) override;
  void freeze() override;
  void serialize(Archive& archive) override;

 private:
  Interactions(Problem& problem, const Mesh& base);
  void add_contact(const Mesh& base, const ContactSpec& spec, const std::string& key);
  ContactSides sides_of(const ContactSpec& spec) const;
  std::shared_ptr<ContactTerm> make_term(const ContactSpec& spec, const ContactDefaults& defaults,
                                         const std::string& key) const;
  void add_suture(const std::string& name, const SutureSpec& spec);
  void start_contacts(const State& start);
  SlavePlaces slaves_of(const std::string& body, const State& state) const;

  Problem& problem_;
  std::map<std::string, std::shared_ptr<RigidSurface>> bodies_;
  std::map<std::string, RigidMotion> motions_;
  std::vector<Contact> contacts_;
  std::map<std::string, std::shared_ptr<SutureTerm>> sutures_;
  std::map<std::string, std::vector<int>> bites_;
  std::map<std::string, std::vector<Point>> suture_places_;
};

}  // namespace bulbus::inline contact
