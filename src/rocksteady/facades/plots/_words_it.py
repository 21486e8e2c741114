"""Italian words of the pages and plots of facades."""

from typing import Final

ITALIAN: Final[dict[str, str]] = {
    "and": "e",
    # Plots
    "wall": "parete",
    "parapet": "parapetto",
    "pinnacle": "pinnacolo",
    "gable": "timpano",
    "the_wall": "la parete",
    "the_parapet": "il parapetto",
    "the_pinnacle": "il pinnacolo",
    "the_gable": "il timpano",
    "hinge": "cerniera",
    "axis_position": "posizione [m]",
    "axis_height": "quota sopra la cerniera [m]",
    "axis_displacement": "spostamento d [mm]",
    "axis_acceleration": "accelerazione spettrale a [g]",
    "axis_share": "spostamento massimo d/d₀",
    "capacity_curve": "curva di capacità a(d)",
    "period_of": "{symbol} = {period}",
    "spectrum_of": "spettro {state}, {damping} %",
    "demand_static": "domanda statica {state}",
    "demand_dynamic": "media delle analisi {state}",
    "demand_linear": "domanda lineare {state}",
    "capacity_linear": "capacità delle verifiche lineari",
    "mean_largest": "media {share}",
    "sign_as recorded": "verso registrato",
    "sign_reversed": "verso opposto",
    # Frame of the page
    "lang": "it",
    "skip": "Vai al contenuto",
    "contents": "Indice",
    "kicker": "Rocksteady · Verifica di un meccanismo locale, Circolare 2019 n. 7, C8.7.1",
    "title": "{name}: le verifiche sono soddisfatte?",
    "footer": (
        "Il programma applica formule pubblicate; la verifica resta compito del progettista. "
        "Nessuna dichiarazione di conformità a norme."
    ),
    # Verdicts
    "satisfied": "soddisfatta",
    "not_satisfied": "non soddisfatta",
    "no_verdict": "senza esito",
    "differ": "metodi discordi",
    "SLD": "stato limite di danno SLD",
    "SLV": "stato limite di salvaguardia della vita SLV",
    "SLC": "stato limite di collasso SLC",
    "method_linear": "analisi cinematica lineare",
    "method_nonlinear static": "analisi cinematica non lineare",
    "method_dynamic": "analisi dinamica non lineare",
    "headline_all": "Tutte le verifiche con una domanda sono soddisfatte.",
    "headline_one": "1 verifica su {all} non è soddisfatta.",
    "headline_some": "{failed} verifiche su {all} non sono soddisfatte.",
    "headline_no": "Nessuna verifica è soddisfatta.",
    "sentence_holds": "{state}: verifica soddisfatta con {methods}.",
    "sentence_fails": "{state}: verifica non soddisfatta con {methods}.",
    "sentence_differs": "{state}: verifica soddisfatta con {passed}, non soddisfatta con {failed}.",
    "sentence_none": (
        "Nessuna verifica: mancano sia la domanda sia gli accelerogrammi. La capacità delle "
        "verifiche lineari è {linear}, lo spostamento a capacità nulla d₀ = {d0}."
    ),
    "why_agree": "Tutti i metodi concordano.",
    "why_nothing": "Per un esito servono una domanda oppure almeno 7 accelerogrammi.",
    # Table of checks
    "checks_caption": (
        "Ogni verifica con la sua formula. † Non confrontata con il testo stampato della norma."
    ),
    "col_state": "stato limite",
    "col_method": "metodo",
    "col_formula": "formula, pagina",
    "col_quantity": "grandezza",
    "col_demand": "domanda",
    "col_capacity": "capacità",
    "col_ratio": "rapporto",
    "col_verdict": "verifica",
    "pages": "pp. {page}",
    "quantity_linear": "accelerazione spettrale {demand} ≤ {capacity}",
    "quantity_nonlinear static": "spostamento spettrale {demand} ≤ {capacity}",
    "quantity_dynamic": "nessuna analisi oltre d₀, media dei d massimi ≤ {capacity}",
    "beyond_all": "oltre d₀",
    # Pictures
    "alt_section": (
        "Sezione: {the}, spessore {thickness}, altezza {height}, cerniera a {inset} dalla faccia "
        "esterna; carichi {loads}, masse che spingono {masses}, catene {ties}, spinte {thrusts}."
    ),
    "alt_capacity": (
        "Capacità in funzione dello spostamento, da {a0} a zero fino ad annullarsi a {d0}, con i "
        "limiti {slv} per SLV e {slc} per SLC{drops}{demands}."
    ),
    "alt_demand": "{state} {demand}",
    "alt_drops": "; cambia dove cessano le azioni, a {places}",
    "alt_demands": "; domande: {demands}",
    "alt_runs": (
        "Spostamento massimo rapportato a d₀ per {records} accelerogrammi e {signs} versi; "
        "{beyond} accelerogrammi oltre d₀; {mean}."
    ),
    "alt_mean": "la media vale {mean}",
    "alt_no_mean": "non c'è media",
    "capacity_note": (
        "Sezione in scala; il profilo tratteggiato è inclinato di 5° a scopo illustrativo. Una "
        "retta per l'origine è un periodo; un quadrato o un rombo a sinistra del proprio limite lo "
        "soddisfa. Le frecce al bordo indicano valori fuori dalla figura."
    ),
    # Sections
    "section_why": "Motivazioni e avvertenze",
    "section_runs": "Accelerogrammi",
    "section_wall": "La parete",
    "section_parapet": "Il parapetto",
    "section_pinnacle": "Il pinnacolo",
    "section_gable": "Il timpano",
    "section_mechanism": "Il meccanismo di ribaltamento",
    "section_demand": "Domanda sismica",
    "section_method": "Metodo",
    "section_limits": "Ipotesi e limiti",
    "section_inputs": "Dati di ingresso",
    # Notes
    "mind_linear": "Le analisi usano le equazioni lineari, valide per piccole rotazioni.",
    "remarks_caption": "Come si ricava ciascuna domanda",
    # The facade
    "fact_kind": "tipo",
    "fact_thickness": "spessore",
    "fact_height": "altezza sopra la cerniera",
    "fact_length": "lunghezza",
    "fact_base": "lunghezza della base",
    "fact_unit_weight": "peso specifico",
    "fact_weight": "peso",
    "fact_hinge": "cerniera, dalla faccia esterna",
    "fact_z": "quota della cerniera dal suolo z",
    "fact_modulus": "modulo elastico E",
    "fact_free": "vibrazione",
    "free": "libero di vibrare (C8.7.1.9)",
    "bound": "vincolato alla costruzione",
    "fact_fc": "fattore di confidenza FC",
    "fact_level": "livello di conoscenza {level}",
    "fact_sides": "oscillazione",
    "one_sided": "monolatera: l'edificio retrostante fa da arresto",
    "two_sided": "bilatera: oscilla verso entrambi i lati",
    "fact_restitution": "coefficiente di restituzione",
    "housner": "dalla conservazione del momento angolare",
    "facade_caption": "Geometria e materiale",
    "acting_caption": (
        "Azioni sull'intera lunghezza; x verso l'interno dalla faccia esterna, z sopra la cerniera."
    ),
    "col_name": "nome",
    "col_kind": "tipo",
    "col_force": "forza",
    "col_end": "fino al collasso",
    "end_counts": "considerata",
    "end_not": "non considerata",
    "end_at": "fino a d = {place}",
    "kind_load": "carico verticale portato",
    "kind_mass": "massa, spinge solo durante il sisma",
    "kind_tie": "catena o tirante, trattiene verso l'interno",
    "kind_thrust": "spinta statica verso l'esterno",
    # The mechanism
    "mechanism_caption": (
        "Grandezze ricavate da geometria e pesi. † Non confrontate con il testo stampato della "
        "norma."
    ),
    "col_symbol": "simbolo",
    "col_meaning": "significato",
    "col_value": "valore",
    "col_source": "da",
    "m_alpha0": "moltiplicatore di attivazione",
    "m_e_star": "frazione di massa partecipante, massa distribuita",
    "m_e_lumped": "frazione di massa partecipante, massa nei baricentri",
    "m_linear": "capacità delle verifiche lineari",
    "m_t0": "periodo di vibrazione elastica",
    "m_arm": "quota dello spostamento d",
    "m_mass": "massa partecipante",
    "m_a0": "accelerazione di attivazione, massa distribuita",
    "m_a0_lumped": "la stessa, massa nei baricentri",
    "m_d0": "spostamento a capacità nulla",
    "m_dslv": "capacità di spostamento SLV, 0,4 d₀",
    "m_dslc": "capacità di spostamento SLC, 0,6 d₀",
    "m_tslv": "periodo secante SLV",
    "m_tslc": "periodo secante SLC",
    "m_theta0": "rotazione a momento stabilizzante nullo, snellezza del blocco",
    "m_p": "parametro di frequenza, con FC",
    "m_lambda": "fattore dell'accelerazione al suolo, con FC",
    "m_uplift": "accelerazione di sollevamento, con tutte le azioni presenti in quiete",
    "m_run": "accelerazione di attivazione delle analisi dinamiche, con FC",
    "m_fc": "fattore di confidenza",
    "equivalent": "blocco equivalente",
    # Demand
    "demand_none": "Non è data alcuna domanda.",
    "demand_caption": "Domanda per ciascuno stato limite",
    "demand_spectrum": ("spettro elastico NTC 2018: a_g {ag}, F₀ {f0}, T_C* {tc}, S {s}, C_C {cc}"),
    "demand_table": "tabella di {count} periodi, da {low} a {high}, smorzamento {damping} %",
    "demand_records": "{count} accelerogrammi, media dei loro spettri",
    # Records
    "runs_intro": (
        "{records} accelerogrammi, {signs}: {the} è un blocco rigido che oscilla solo verso "
        "l'esterno (oscillazione monolatera), e il moto è seguito fino alla quiete o al "
        "ribaltamento. Di ogni accelerogramma conta lo spostamento maggiore."
    ),
    "runs_intro_two_sided": (
        "{records} accelerogrammi, {signs}: {the} è un blocco rigido che oscilla verso entrambi "
        "i lati, e il moto è seguito fino alla quiete o al ribaltamento. Di ogni accelerogramma "
        "conta lo spostamento maggiore."
    ),
    "signs_2": "in entrambi i versi",
    "signs_1": "in un solo verso",
    "runs_caption": "Spostamento massimo per ciascun accelerogramma, nei versi analizzati.",
    "col_record": "accelerogramma",
    "col_pga": "PGA",
    "col_scale": "fattore",
    "col_largest": "maggiore/d₀",
    "status_at-rest": "in quiete",
    "status_rocking": "in oscillazione",
    "status_overturned": "ribaltamento",
    "status_lost-contact": "contatto perso",
    "status_undecided": "esito indeciso",
    "beyond": "oltre d₀",
    "still": "non si solleva",
    "vertical": "con componente verticale",
    "mean_row": "media",
    "runs_note": "Una barra con la freccia va oltre d₀.",
    # Method
    "method_1_name": "Analisi cinematica.",
    "method_1": (
        "{The} ruota verso l'esterno attorno alla cerniera. Con i pesi P che partecipano alla "
        "rotazione, le masse Q che spingono, le catene T e le spinte H, M = ΣP(x − x_h) + ΣTz − "
        "ΣHz è il momento stabilizzante e D = Σ(P + Q)z quello ribaltante per α = 1: α₀ = M/D "
        "(1)†. Con e* = D²/(Σ(P + Q) Σ(P + Q)z²) (5)† si ha a₀ = α₀ g/(e* FC) (3)†, e la "
        "capacità decresce linearmente fino ad annullarsi a d₀ = z_d M/ΣPz, z_d = Σ(P + Q)z²/D. "
        "α₀ considera tutte le azioni presenti in quiete, d₀ soltanto quelle di cui "
        "è verificata la presenza fino al collasso (C8.7.1.2.1.6)†."
    ),
    "method_2_name": "Verifica lineare.",
    "method_2": (
        "SLD: l'accelerazione di picco alla base S_e(0) non supera min a₀ (8)†. SLV: S_e(0) divisa "
        "per il fattore di comportamento q = 2 non supera min a₀†. min a₀ è il minore di due "
        "valori: con la massa distribuita nei corpi e con la massa nei loro baricentri. Elemento "
        "libero di vibrare: S_e(T₀, z) con smorzamento 5 % non supera α₀ g/FC per "
        "entrambi, con T₀ = 6,2 (L/t) L √(W/(g E)) (9)†."
    ),
    "method_3_name": "Verifica statica non lineare.",
    "method_3": (
        "T_SLV = 1,68 π √(d_SLV/a(d_SLV)) (10)†, T_SLC = 1,56 π √(d_SLC/a(d_SLC)) (11)†. La "
        "domanda è S_D(T) = S_e(T) T²/(4π²) (12)†, con smorzamento 8 % per SLV e 10 % per SLC."
    ),
    "method_4_name": "Verifica dinamica non lineare.",
    "method_4": (
        "Nessuna analisi supera d₀, e la media su almeno 7 accelerogrammi degli spostamenti "
        "massimi non supera d_SLV o d_SLC (C8.7.1.2.1.9)†. Tra un urto e l'altro si risolve "
        "θ″ = −p² [sin(θ₀ − θ) − λ (a/g) cos(θ₀ − θ)] con p² = g √(M² + K²)/(I FC), λ = FC D/K, "
        "K = ΣPz, θ₀ = atan(M/K), e d = z_d (M/K) θ/θ₀: un blocco rigido, non un "
        "oscillatore. Le azioni che cessano e trattengono sono escluse dall'inizio; quelle che "
        "cessano e non trattengono agiscono sempre."
    ),
    # Assumptions
    "assumed": "Si assume",
    "assumed_bullets": (
        "Soltanto d_SLV = 0,4 d₀ e d_SLC = 0,6 d₀: la seconda condizione su ciascuno non è "
        "leggibile, e i limiti potrebbero essere minori†."
    ),
    "assumed_t0": (
        "Con gli accelerogrammi lo spostamento spettrale massimo è cercato dal periodo 0 fino a "
        "T_SLV o T_SLC: l'estremo inferiore T₀ non è leggibile†. La domanda non risulta mai "
        "minore."
    ),
    "assumed_mean": (
        "Gli accelerogrammi rappresentano il sito e lo stato limite; per la media degli "
        "spostamenti massimi ne servono 7. Basta un'analisi oltre d₀ perché la verifica non sia "
        "soddisfatta, qualunque sia la media."
    ),
    "assumed_fc": (
        "Il fattore di confidenza FC divide il momento stabilizzante anche nelle analisi "
        "dinamiche: {the} si solleva a 1/FC dell'accelerazione e ritorna più lentamente."
    ),
    "assumed_block": (
        "Il blocco equivalente è esatto quando tutte le masse sono allineate con la cerniera e non "
        "agisce altro; con catene, spinte e masse che spingono è approssimato all'ordine θ²."
    ),
    "assumed_balance": "Un'analisi oltre d₀ conta come ribaltamento, anche se {the} ritorna.",
    "assumed_restitution": (
        "Il coefficiente di restituzione è una scelta: i valori misurati per la muratura sono "
        "dispersi, e un valore maggiore sottrae meno al moto a ogni urto."
    ),
    "not_covered": "Resta escluso",
    "not_rigid": (
        "Un solo corpo rigido e monolitico: una parete a paramenti scollegati si disgrega prima di "
        "ruotare."
    ),
    "not_crushing": "Nessuno schiacciamento alla cerniera oltre l'arretramento assegnato.",
    "not_sliding": "Nessuno scorrimento sulla base, né di ciò che è portato.",
    "not_diaphragm": (
        "Nessun solaio, tetto o diaframma flessibile: i carichi mantengono il proprio peso e "
        "l'edificio retrostante non si muove rispetto al suolo."
    ),
    "not_ties": (
        "Le catene e i tiranti esercitano una forza costante finché non cessano: nessun "
        "allungamento, snervamento o sfilamento."
    ),
    "not_corners": "Nessun ammorsamento con i muri trasversali, né attrito contro di essi.",
    "not_height": (
        "Nessuna amplificazione lungo l'altezza dell'edificio, salvo che la domanda sia uno "
        "spettro di piano o gli accelerogrammi siano di piano."
    ),
    # Inputs
    "inputs_files": "File letti, con lo SHA-256 del loro contenuto.",
    "inputs_file": "file",
    "inputs_command": "Comando che produce di nuovo questa pagina, con gli stessi file:",
    "inputs_motions": "Accelerogrammi, con le prime 16 cifre dello SHA-256 dei campioni.",
    "inputs_made": "Prodotto da rocksteady {version} (kernel {kernels}, NumPy {numpy}).",
    # Remarks of the checks
    "remark_eta": "η = {0} per smorzamento {1} %",
    "remark_beyond_4_s": (
        "T = {0} s supera i 4 s a cui termina lo spettro delle NTC 2018: lo spostamento è "
        "mantenuto costante"
    ),
    "remark_table_as_given": "tabella con smorzamento {0} %",
    "remark_table_between": "tabella interpolata tra {0} e {1} % di smorzamento, a {2} %",
    "remark_table_scaled": (
        "tabella con smorzamento {0} % riportata a {1} % con il fattore {2}, rapporto degli η"
    ),
    "remark_records": (
        "media sugli accelerogrammi del massimo S_D dal periodo 0 a T; l'estremo inferiore T₀ non "
        "è leggibile: a favore di sicurezza"
    ),
    "remark_peak_of_records": "media delle PGA degli accelerogrammi",
    "remark_q": "S_e(0) diviso q = {0}",
    "remark_no_demand": "nessuna domanda assegnata per {0}: solo la capacità",
    "remark_no_runs": "nessuna analisi con accelerogrammi",
    "remark_few_records": "la media richiede almeno {0} accelerogrammi",
    "remark_beyond_d0": "analisi oltre d₀ con {0}",
    "remark_weak_records": (
        "nessuna risposta: gli accelerogrammi hanno una PGA media di {0} g, la domanda {2} di "
        "{1} g; scalarli con --pga-g"
    ),
    "remark_mean_of_runs": "media degli spostamenti massimi, nessuna analisi oltre d₀",
    "remark_linear_or_displacement": (
        "La verifica lineare confronta l'accelerazione di picco divisa per q = 2 con a₀, che non "
        "dipende dalle dimensioni; la capacità di spostamento cresce con lo spessore."
    ),
    "remark_static_or_dynamic": (
        "La domanda statica non lineare è lo spostamento di un oscillatore elastico di periodo "
        "secante {0} s e smorzamento {1} %; quella dinamica è lo spostamento di un blocco rigido "
        "che si solleva, ricade e perde velocità a ogni urto."
    ),
    "remark_free_or_displacement": (
        "La verifica lineare confronta S_e(T0) con alpha_0 g/FC, che non dipende dalle dimensioni; "
        "la capacità di spostamento cresce con lo spessore."
    ),
    "remark_standard": (
        "Formule della Circolare 2019 n. 7, C8.7.1, pp. 272–277: non confrontate con il testo "
        "stampato della norma."
    ),
    "remark_ending": (
        "d0 considera soltanto le azioni di cui è verificata la presenza fino al collasso "
        "(C8.7.1.2.1.6): non {0}."
    ),
    "remark_e_star": (
        "a0 vale {0} g con la massa distribuita (e* = {1}) e {2} g con la massa di ogni corpo nel "
        "suo baricentro (e* = {3}): nelle verifiche lineari decide il minore."
    ),
    "remark_e_star_free": (
        "a0 varrebbe {0} g con la massa distribuita (e* = {1}) e {2} g con la massa di ogni corpo "
        "nel suo baricentro (e* = {3}); decide alpha_0 g/FC = {4} g (C8.7.1.9)."
    ),
    "remark_free": (
        "S_e(T0 = {0} s) con smorzamento 5 %, a z = {1} m, senza q: l'elemento è libero di vibrare"
    ),
    "remark_rigid_runs": (
        "Le analisi dinamiche considerano l'elemento rigido: la sua vibrazione elastica è esclusa."
    ),
    "remark_gable_top": (
        "Il timpano è verificato come vincolato alla costruzione retrostante: una sommità libera "
        "di vibrare ha one_sided = false."
    ),
    "remark_second_conditions": (
        "La seconda condizione su d_SLV e su d_SLC non è leggibile: si usano soltanto 0,4 d₀ e "
        "0,6 d₀."
    ),
    "remark_uplift": (
        "Il sollevamento avviene ad α₀ g = {0} g. Nelle analisi dinamiche il moto inizia a {1} g: "
        "FC divide la resistenza, e le azioni che trattengono e non sono verificate fino al "
        "collasso sono escluse. La curva di capacità dell'elemento rigido inizia ad a₀ = {2} g."
    ),
    "remark_in_line": (
        "Con carichi, catene, spinte o masse che spingono il blocco equivalente è approssimato "
        "all'ordine θ²; è esatto dove tutte le masse sono allineate con la cerniera."
    ),
}
