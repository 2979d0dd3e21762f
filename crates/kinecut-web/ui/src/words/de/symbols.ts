// German symbols of the quantities of a drilling, by their names in JSON; those without a usual one have none.

export const symbols: Record<string, string> = {
  L_vr1: "l_s",
  L_vr2: "",
  L_nvr: "",
  L_vr: "",
  L_ust: "l_v",
  L_vyh1: "l_s",
  L_vyh2: "",
  L_kvyh: "",
  L_vyh: "",
  L_rx: "L",
  Z_nvr1: "",
  Z_nvr2: "",
  Z_nvyh1: "",
  Z_nvyh2: "",
  Z_kvyh1: "",
  Z_kvyh2: "",
};
