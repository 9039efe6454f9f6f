-- RTL in VHDL with the ports of a DSDPV1: the levels of the reset, for ever.
library ieee;
use ieee.std_logic_1164.all;

entity dsdpv1 is
  port (
    fault_i : in std_logic_vector(7 downto 0);
    reset_i, clk_i, pbrxd_i, r_req_i, r_sta_i, csr_i, rd_i, wr_i : in std_logic;
    a_i : in std_logic_vector(10 downto 0);
    d_i : in std_logic_vector(7 downto 0);
    d_o : out std_logic_vector(7 downto 0);
    pbtxd_o, pbrts_o, l_req_o, l_sta_o, d_oe_o, intr0_o, pbf_o, br_o, ready_o : out std_logic);
end entity;

architecture dead of dsdpv1 is
  signal held : std_logic_vector(7 downto 0);
begin
  process (clk_i)
  begin
    if rising_edge(clk_i) then
      held <= d_i;
    end if;
  end process;
  d_o <= held;
  pbtxd_o <= '1';
  intr0_o <= '1';
  pbf_o <= '1';
  pbrts_o <= '0';
  l_req_o <= '0';
  l_sta_o <= '0';
  d_oe_o <= '0';
  br_o <= '0';
  ready_o <= '0';
end architecture;
