// Ukrainian symbols of the quantities of a drilling, by their names in JSON.

export const symbols: Record<string, string> = {
  L_vr1: "L_вр1",
  L_vr2: "L_вр2",
  L_nvr: "L_нвр",
  L_vr: "L_вр",
  L_ust: "L_уст",
  L_vyh1: "L_вих1",
  L_vyh2: "L_вих2",
  L_kvyh: "L_квих",
  L_vyh: "L_вих",
  L_rx: "L_рх",
  Z_nvr1: "Z_нвр1",
  Z_nvr2: "Z_нвр2",
  Z_nvyh1: "Z_нвих1",
  Z_nvyh2: "Z_нвих2",
  Z_kvyh1: "Z_квих1",
  Z_kvyh2: "Z_квих2",
};
